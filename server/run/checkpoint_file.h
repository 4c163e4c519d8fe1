#pragma once

#include <cstdint>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>

/// A checkpoint on the disk: a header (magic, version of this form, build, length), the bytes of
/// Simulation::save(), and their SHA-256.
namespace lather::server {

/// A file that holds no usable checkpoint; the words say why.
class CheckpointError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// "000000012345.checkpoint"
[[nodiscard]] std::string checkpoint_file_name(std::uint64_t step);

/// Writes it whole and says its bytes. Throws std::system_error naming the file.
std::uint64_t write_checkpoint(const std::filesystem::path& file, std::string_view state);

/// The state. Throws CheckpointError for a file that is not there, is damaged, or that another build wrote:
/// only the same build is sure to go on with the same bits.
[[nodiscard]] std::string read_checkpoint(const std::filesystem::path& file);

/// Names the running program by its linker's build id, as lower-case hexadecimal; its version where it has
/// none.
[[nodiscard]] const std::string& build_id();

}  // namespace lather::server
