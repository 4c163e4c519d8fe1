#pragma once

#include <filesystem>
#include <string>

/// Where things lie in the data directory: DATA/jobs/ID/attempts/K/{report.json, probes.csv, log.txt,
/// frames/main/color/NNNNN.png, checkpoints/STEP.checkpoint}.
namespace lather::server {

[[nodiscard]] inline std::filesystem::path jobs_directory(const std::filesystem::path& data) {
  return data / "jobs";
}
[[nodiscard]] inline std::filesystem::path job_directory(const std::filesystem::path& data,
                                                         const std::string& id) {
  return jobs_directory(data) / id;
}

inline constexpr const char* kFramesPath =
    "frames/main/color";  ///< below an attempt: camera "main", channel "color"
inline constexpr const char* kCheckpointsPath = "checkpoints";
inline constexpr const char* kReportName = "report.json";
inline constexpr const char* kProbesName = "probes.csv";
inline constexpr const char* kLogName = "log.txt";

/// Relative to the job's directory.
[[nodiscard]] inline std::string attempt_path(int attempt) {
  return "attempts/" + std::to_string(attempt);
}

}  // namespace lather::server
