#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "server/http/message.h"

namespace lather::server {

enum class FilmKind { kMp4, kWebm };  ///< H.264 in MP4, VP9 in WebM

/// The program's file on PATH, or `name` itself where it holds a slash; none where nothing can be executed.
[[nodiscard]] std::optional<std::filesystem::path> find_program(const std::string& name);

/// Pictures of one size, PNG, one after the other; none after the last one. Throws to break the film off.
using NextPicture = std::function<std::optional<std::string>()>;

/// Has `ffmpeg` make a film of the pictures, `rate` a second, and writes it into the sink as it comes. False
/// when it could not be finished: the program failed or fell silent, or the reader is gone. Throws
/// std::system_error when it cannot be started.
bool write_film(const std::filesystem::path& ffmpeg, FilmKind kind, double rate, const NextPicture& next,
                const BodySink& sink);

}  // namespace lather::server
