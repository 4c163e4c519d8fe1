#include "server/run/render_thread.h"

#include <chrono>
#include <utility>

#include "render/render.h"
#include "server/artifacts/digest.h"
#include "server/artifacts/whole_file.h"
#include "sim/simulation.h"

namespace lather::server {
namespace {

constexpr std::size_t kMostWaiting = 2;

}  // namespace

RenderThread::RenderThread(const Plan& plan, std::filesystem::path frames, const std::string& render_backend,
                           int threads, RunEvents& events)
    : plan_(plan), frames_(std::move(frames)), events_(events), scene_hash_(scene_hash(plan.scene)) {
  thread_ = std::thread([this, render_backend, threads] { main(render_backend, threads); });
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

bool RenderThread::push(Frame frame) {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [&] { return waiting_.size() < kMostWaiting || failure_; });
  if (failure_) return false;
  waiting_.push_back(std::move(frame));
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

bool RenderThread::take(Frame& frame) {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [&] { return !waiting_.empty() || closed_; });
  if (waiting_.empty()) return false;
  frame = std::move(waiting_.front());
  waiting_.pop_front();
  changed_.notify_all();
  return true;
}

void RenderThread::main(const std::string& render_backend, int threads) {
  using Clock = std::chrono::steady_clock;
  try {
    const auto renderer = render::Renderer::create(render::backend_from_string(render_backend),
                                                   plan_.scene.look, plan_.scene.output, threads);
    backend_ = renderer->backend();
    {
      const std::lock_guard lock(mutex_);
      ready_ = true;
      changed_.notify_all();
    }
    Frame frame;
    while (take(frame)) {
      const auto start = Clock::now();
      const render::PngText text = {scene_hash_, version(), plan_.scene.name, frame.time, frame.index};
      const std::string png = renderer->draw_png(frame, text);
      seconds_ += std::chrono::duration<double>(Clock::now() - start).count();
      const std::string name = frame_file_name(frame.index);
      write_whole(frames_ / name, png);
      events_.frame({frame.index, name, sha256_hex(png), png.size()});
    }
  } catch (...) {
    const std::lock_guard lock(mutex_);
    failure_ = std::current_exception();
    changed_.notify_all();
  }
}

}  // namespace lather::server
