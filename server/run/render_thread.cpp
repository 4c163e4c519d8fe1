#include "server/run/render_thread.h"

#include <chrono>
#include <system_error>
#include <utility>

#include "render/render.h"
#include "server/artifacts/digest.h"
#include "server/artifacts/whole_file.h"
#include "server/run/checkpoint_file.h"
#include "sim/simulation.h"

namespace lather::server {
namespace {

constexpr std::size_t kMostWaiting = 2;

}  // namespace

RenderThread::RenderThread(const Scene& drawn, const Scene& named, const RunSettings& settings,
                           RunEvents& events)
    : scene_(drawn),
      settings_(settings),
      files_(settings.files.empty() ? std::vector<FrameFileKind>{} : planned_files(drawn.output)),
      events_(events),
      scene_hash_(scene_hash(named)),
      scene_json_(to_json(named)) {
  make_directories(settings_.frames);
  for (const FrameFileKind& kind : files_) make_directories(settings_.files / kind.folder);
  if (!settings_.checkpoints.empty()) make_directories(settings_.checkpoints);
  thread_ = std::thread([this] { main(); });
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [&] { return ready_ || failure_; });
  if (!failure_) return;
  lock.unlock();
  thread_.join();
  std::rethrow_exception(failure_);
}

RenderThread::~RenderThread() {
  close(false);
  if (thread_.joinable()) thread_.join();
}

bool RenderThread::push(Item item) {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [&] { return waiting_.size() < kMostWaiting || failure_; });
  if (failure_) return false;
  waiting_.push_back(std::move(item));
  changed_.notify_all();
  return true;
}

void RenderThread::finish(bool draw_rest) {
  close(draw_rest);
  if (thread_.joinable()) thread_.join();
  if (failure_) std::rethrow_exception(failure_);
}

void RenderThread::close(bool draw_rest) {
  const std::lock_guard lock(mutex_);
  closed_ = true;
  if (!draw_rest) waiting_.clear();
  changed_.notify_all();
}

bool RenderThread::take(Item& item) {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [&] { return !waiting_.empty() || closed_; });
  if (waiting_.empty()) return false;
  item = std::move(waiting_.front());
  waiting_.pop_front();
  changed_.notify_all();
  return true;
}

void RenderThread::main() {
  try {
    const auto renderer = render::Renderer::create(render::backend_from_string(settings_.render_backend),
                                                   scene_.look, scene_.output, settings_.threads);
    backend_ = renderer->backend();
    {
      const std::lock_guard lock(mutex_);
      ready_ = true;
      changed_.notify_all();
    }
    Item item;
    while (take(item)) {
      if (const Frame* frame = std::get_if<Frame>(&item))
        draw(*renderer, *frame);
      else
        write(std::get<Checkpoint>(item));
    }
  } catch (...) {
    const std::lock_guard lock(mutex_);
    failure_ = std::current_exception();
    changed_.notify_all();
  }
}

void RenderThread::draw(render::Renderer& renderer, const Frame& frame) {
  using Clock = std::chrono::steady_clock;
  const auto start = Clock::now();
  const render::PngText text = {scene_hash_, version(), scene_.name, frame.time, frame.index, scene_json_};
  write(frame, renderer.draw_png(frame, text));
  seconds_ += std::chrono::duration<double>(Clock::now() - start).count();
}

/// The picture last: where it is, its frame's other files are.
void RenderThread::write(const Frame& frame, const std::string& png) {
  for (const FrameFileKind& kind : files_)
    write_whole(settings_.files / kind.folder / frame_file_name(frame.index, kind.ending), kind.bytes(frame));
  const std::string name = frame_file_name(frame.index);
  write_whole(settings_.frames / name, png);
  events_.frame({frame.index, name, sha256_hex(png), png.size()});
}

void RenderThread::write(const Checkpoint& checkpoint) {
  try {
    const std::uint64_t size =
        write_checkpoint(settings_.checkpoints / checkpoint_file_name(checkpoint.step), checkpoint.state);
    events_.checkpoint({checkpoint.step, checkpoint.time, size});
  } catch (const std::system_error& failure) {
    if (!checkpoint.spare) throw;
    events_.log(std::string("warning: there is no last checkpoint: ") + failure.what());
  }
}

}  // namespace lather::server
