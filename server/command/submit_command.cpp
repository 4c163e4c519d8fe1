#include <chrono>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <set>
#include <stdexcept>
#include <string>
#include <string_view>
#include <thread>
#include <utility>
#include <variant>
#include <vector>

#include "server/artifacts/digest.h"
#include "server/artifacts/whole_file.h"
#include "server/command/commands.h"
#include "server/command/progress_bar.h"
#include "server/command/scene_source.h"
#include "server/http/client.h"
#include "server/http/job_json.h"
#include "server/run/run.h"
#include "sim/scene/value.h"

namespace lather::server {
namespace {

constexpr auto kPollInterval = std::chrono::milliseconds(250);

std::string text_of(const Value& object, const char* key) {
  const Value* const value = object.find(key);
  return value && value->text() ? *value->text() : std::string();
}

double number_of(const Value* object, const char* key, double otherwise) {
  const Value* const value = object ? object->find(key) : nullptr;
  if (!value) return otherwise;
  if (const auto* whole = std::get_if<std::int64_t>(&value->data)) return static_cast<double>(*whole);
  if (const auto* real = std::get_if<double>(&value->data)) return *real;
  return otherwise;
}

/// As in the scene's file: what is sent wraps it in {"scene": …}.
std::string pointer_in_scene(const std::string& pointer) {
  static constexpr std::string_view kWrap = "/scene";
  return pointer.compare(0, kWrap.size(), kWrap) == 0 ? pointer.substr(kWrap.size()) : pointer;
}

/// The server's problem document as the error that the command line reports.
[[noreturn]] void refuse(const ApiClient::Answer& answer) {
  const Value document = parse_json(answer.body);
  std::vector<Problem> problems;
  if (const Value* errors = document.find("errors"); errors && errors->array())
    for (const Value& error : *errors->array())
      problems.push_back({pointer_in_scene(text_of(error, "pointer")), text_of(error, "value"),
                          text_of(error, "allowed"), text_of(error, "message")});
  if (problems.empty()) throw std::runtime_error("the server answered: " + text_of(document, "detail"));
  throw InputError(std::move(problems));
}

std::string request_body(const SceneSource& source) {
  Object set;
  for (const Override& change : read_overrides(source.set)) {
    Value value = change.json;
    try {
      value = parse_json(change.json);
    } catch (const InputError&) {  // text that is no JSON is a string
    }
    set.emplace_back(change.pointer, std::move(value));
  }
  Object envelope = {{"scene", parse_json(read_text(source.file))}};
  if (!source.size.empty()) envelope.emplace_back("size", source.size);
  if (!set.empty()) envelope.emplace_back("set", std::move(set));
  return write_json(envelope);
}

class Download {
 public:
  Download(ApiClient& client, std::string job, const std::filesystem::path& out)
      : client_(client), job_(std::move(job)), out_(out) {
    if (!out_.empty()) std::filesystem::create_directories(out_ / "frames");
  }

  /// The job's state, as a document.
  [[nodiscard]] Value state() const { return document(job_); }

  /// Fetches the frames that are there and have not been fetched.
  void fetch_frames() {
    if (out_.empty()) return;
    const Value listing = document(job_ + "/frames");
    const Value* const frames = listing.find("frames");
    if (!frames || !frames->array()) return;
    for (const Value& frame : *frames->array()) {
      const int index = static_cast<int>(number_of(&frame, "index", -1));
      if (index < 0 || fetched_.count(index) != 0) continue;
      const ApiClient::Answer picture = client_.get(job_ + "/frames/" + std::to_string(index) + ".png");
      if (picture.status != 200) refuse(picture);
      write_whole(out_ / "frames" / frame_file_name(index), picture.body);
      fetched_.insert(index);
    }
  }

  void fetch_report() const {
    if (out_.empty()) return;
    const ApiClient::Answer report = client_.get(job_ + "/report");
    if (report.status == 200) write_whole(out_ / "report.json", report.body);
  }

 private:
  [[nodiscard]] Value document(const std::string& path) const {
    const ApiClient::Answer answer = client_.get(path);
    if (answer.status != 200) refuse(answer);
    return parse_json(answer.body);
  }

  ApiClient& client_;
  const std::string job_;
  const std::filesystem::path out_;
  std::set<int> fetched_;
};

void show(ProgressBar& bar, const Value& job, const std::string& state) {
  const Value* const progress = job.find("progress");
  const int frames = static_cast<int>(number_of(progress, "frames", 0));
  const std::string text = state == "queued"
                               ? std::string("waiting in the queue")
                               : std::to_string(static_cast<int>(number_of(&job, "frames", 0))) + " of " +
                                     std::to_string(frames) + " frames";
  bar.show(number_of(progress, "fraction", 0), number_of(progress, "eta_seconds", -1), text);
}

/// Until the job has ended; its last document.
Value follow(Download& download, bool quiet) {
  ProgressBar bar;
  while (true) {
    Value job = download.state();
    const std::string state = text_of(job, "state");
    if (!quiet) show(bar, job, state);
    download.fetch_frames();
    if (has_ended(job_state_from_string(state))) return job;
    std::this_thread::sleep_for(kPollInterval);
  }
}

}  // namespace

int submit_command(const SubmitOptions& options) {
  ApiClient client(options.server);
  const std::string jobs = std::string(kApi) + "/jobs";
  const ApiClient::Answer posted = client.post(jobs, request_body(options.scene), random_token(22));
  if (posted.status != 201) refuse(posted);
  const std::string id = text_of(parse_json(posted.body), "id");
  if (!options.json) std::fprintf(stderr, "job %s\n", id.c_str());

  Download download(client, jobs + '/' + id, options.out);
  const Value job = follow(download, options.json);
  download.fetch_report();
  const std::string state = text_of(job, "state");
  if (options.json)
    std::printf("%s\n", write_json(job).c_str());
  else if (state == "succeeded" && !options.out.empty())
    std::printf("%d frames in %s\n", static_cast<int>(number_of(&job, "frames", 0)),
                (options.out / "frames").c_str());
  if (state == "succeeded") return 0;
  std::fprintf(stderr, "the job %s. %s\n", state.c_str(), text_of(job, "error").c_str());
  return kExitSimulation;
}

}  // namespace lather::server
