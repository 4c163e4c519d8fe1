#include "server/agent/recovery.h"

#include <set>
#include <string>
#include <system_error>
#include <vector>

#include "server/artifacts/layout.h"
#include "server/artifacts/whole_file.h"
#include "server/run/run.h"

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

/// Pictures that were renamed but whose row was never written: the server ended in between.
std::size_t sweep_unpublished(Store& store, const fs::path& directory, const std::string& id) {
  std::set<fs::path> published;
  for (const FrameRow& frame : store.frames(id))
    published.insert(directory / attempt_path(frame.attempt) / kFramesPath / frame_file_name(frame.index));
  std::size_t removed = 0;
  std::error_code ignored;
  for (const fs::path& attempt : entries(directory / "attempts"))
    for (const fs::path& file : entries(attempt / kFramesPath))
      if (published.count(file) == 0 && fs::remove(file, ignored)) ++removed;
  return removed;
}

}  // namespace

Recovery recover(Store& store, const fs::path& data) {
  Recovery done;
  done.jobs = store.recover();
  done.files = sweep_parts(jobs_directory(data));
  for (const fs::path& directory : entries(jobs_directory(data))) {
    const std::string id = directory.filename().string();
    if (store.find(id)) {
      done.files += sweep_unpublished(store, directory, id);
    } else if (is_job_id(id)) {
      std::error_code ignored;
      fs::remove_all(directory, ignored);
      ++done.directories;
    }
  }
  return done;
}

}  // namespace lather::server
