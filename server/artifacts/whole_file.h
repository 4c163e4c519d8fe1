#pragma once

#include <cstddef>
#include <filesystem>
#include <initializer_list>
#include <string_view>

/// Files of jobs are written whole: a reader sees all of a file or none of it, also after a power cut.
namespace lather::server {

/// The suffix of a file that is still being written.
inline constexpr std::string_view kPartSuffix = ".part";

/// Writes `bytes` to `file`.part, syncs it, renames it to `file` and syncs the directory.
/// Throws std::system_error naming the file; the part is removed then. A failed sync is never retried on the
/// same descriptor, for the kernel forgets what it could not write.
void write_whole(const std::filesystem::path& file, std::string_view bytes);
/// The same with the parts one after the other.
void write_whole(const std::filesystem::path& file, std::initializer_list<std::string_view> parts);

/// Makes the directory and those above it that are missing, each synced into the one above it: what is
/// written whole into it is then found after a power cut. Throws std::system_error naming what failed.
void make_directories(const std::filesystem::path& directory);

/// Removes a directory with all in it, also while another thread removes files of it. False when something
/// stays.
bool remove_tree(const std::filesystem::path& directory);

/// Removes every .part below `root` (left by a crash) and says how many there were.
std::size_t sweep_parts(const std::filesystem::path& root);

}  // namespace lather::server
