#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "server/job/job.h"
#include "sim/scene/value.h"

/// Jobs and frames as the API shows them.
namespace lather::server {

inline constexpr const char* kApi = "/api/v1";

/// `frames`: how many have been published.
[[nodiscard]] Value job_value(const Job& job, std::size_t frames);
[[nodiscard]] Value frame_value(const Job& job, const FrameRow& frame);
[[nodiscard]] Value frames_value(const Job& job, const std::vector<FrameRow>& frames);

}  // namespace lather::server
