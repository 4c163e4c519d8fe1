#include "server/agent/recovery.h"

#include <charconv>
#include <optional>
#include <set>
#include <string>
#include <system_error>
#include <vector>

#include "server/artifacts/layout.h"
#include "server/artifacts/whole_file.h"
#include "server/run/checkpoint_file.h"
#include "server/run/run.h"
#include "sim/export/frame_files.h"

namespace lather::server {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> entries(const fs::path& directory) {
  std::vector<fs::path> found;
  std::error_code ignored;
  for (fs::directory_iterator entry(directory, ignored), end; entry != end; entry.increment(ignored))
    found.push_back(entry->path());
  return found;
}

/// What the rows of a job's attempt name.
struct Named {
  std::set<std::string> frames;       ///< "00042"
  std::set<std::string> checkpoints;  ///< file names
};

Named named_by_rows(Store& store, const std::string& id, int attempt) {
  Named named;
  for (const FrameRow& frame : store.frames(id))
    if (frame.attempt == attempt) named.frames.insert(fs::path(frame_file_name(frame.index)).stem().string());
  for (const CheckpointRow& row : store.checkpoints(id))
    if (row.attempt == attempt) named.checkpoints.insert(checkpoint_file_name(row.step));
  return named;
}

bool remove_if_there(const fs::path& file) {
  std::error_code ignored;
  return fs::remove(file, ignored);
}

/// The directories of an attempt that hold a file a frame.
std::set<fs::path> frame_directories(const fs::path& attempt) {
  std::set<fs::path> directories = {attempt / kFramesPath};
  for (const FrameFileKind& kind : frame_file_kinds()) directories.insert(attempt / kind.folder);
  return directories;
}

std::size_t sweep_job(Store& store, const fs::path& directory, const std::string& id) {
  std::size_t removed = 0;
  for (const fs::path& attempt : entries(directory / "attempts")) {
    const std::string name = attempt.filename().string();
    int number = 0;
    const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), number);
    if (error == std::errc{} && end == name.data() + name.size())
      removed += sweep_attempt(store, directory, id, number);
  }
  return removed;
}

}  // namespace

fs::path checkpoint_path(const fs::path& directory, const CheckpointRow& row) {
  return directory / attempt_path(row.attempt) / kCheckpointsPath / checkpoint_file_name(row.step);
}

void remove_file(const fs::path& file) {
  static_cast<void>(remove_if_there(file));
}

std::size_t sweep_attempt(Store& store, const fs::path& directory, const std::string& id, int attempt) {
  const fs::path own = directory / attempt_path(attempt);
  const Named named = named_by_rows(store, id, attempt);
  const std::optional<Job> job = store.find(id);
  if (job && job->attempt > attempt && named.frames.empty() && named.checkpoints.empty()) {
    static_cast<void>(remove_tree(own));
    return 0;
  }
  std::size_t removed = sweep_parts(own);
  for (const fs::path& frames : frame_directories(own))
    for (const fs::path& file : entries(frames))
      if (named.frames.count(file.stem().string()) == 0 && remove_if_there(file)) ++removed;
  for (const fs::path& file : entries(own / kCheckpointsPath))
    if (named.checkpoints.count(file.filename().string()) == 0 && remove_if_there(file)) ++removed;
  return removed;
}

Recovery recover(Store& store, const fs::path& data) {
  Recovery done;
  done.jobs = store.recover();
  done.files = sweep_parts(jobs_directory(data));
  for (const fs::path& directory : entries(jobs_directory(data))) {
    const std::string id = directory.filename().string();
    if (store.find(id)) {
      done.files += sweep_job(store, directory, id);
    } else if (is_job_id(id)) {
      static_cast<void>(remove_tree(directory));
      ++done.directories;
    }
  }
  return done;
}

}  // namespace lather::server
