#include "server/run/checkpoint_file.h"

#include <elf.h>
#include <fcntl.h>
#include <link.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <type_traits>

#include "server/artifacts/digest.h"
#include "server/artifacts/owned_fd.h"
#include "server/artifacts/whole_file.h"
#include "sim/simulation.h"

namespace lather::server {
namespace {

constexpr std::array<char, 8> kMagic = {'l', 'a', 't', 'h', 'e', 'r', 'C', 'P'};
constexpr std::uint32_t kForm = 1;
constexpr std::size_t kChecksumBytes = 64;  // SHA-256 in hexadecimal

/// In the machine's own byte order, as the state itself is: another machine's is refused by its form.
struct Header {
  std::array<char, 8> magic = kMagic;
  std::uint32_t form = kForm;
  std::uint32_t header_bytes = sizeof(Header);
  std::array<char, 64> build = {};  // padded with NUL
  std::uint64_t state_bytes = 0;
};
static_assert(sizeof(Header) == 88 && std::is_trivially_copyable_v<Header>);

std::array<char, 64> padded_build() {
  std::array<char, 64> padded = {};
  const std::string& build = build_id();
  std::copy_n(build.begin(), std::min(build.size(), padded.size()), padded.begin());
  return padded;
}

void read_all(int fd, char* to, std::size_t size) {
  while (size > 0) {
    const ssize_t got = ::read(fd, to, size);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) throw CheckpointError(std::string("it cannot be read: ") + std::strerror(errno));
    if (got == 0) throw CheckpointError("it ends too early");
    to += got;
    size -= static_cast<std::size_t>(got);
  }
}

void check_header(const Header& header, std::uint64_t file_bytes) {
  if (header.magic != kMagic) throw CheckpointError("it is no checkpoint");
  if (header.form != kForm || header.header_bytes != sizeof header)
    throw CheckpointError("its form is " + std::to_string(header.form) + ", this build reads " +
                          std::to_string(kForm));
  if (header.build != padded_build()) throw CheckpointError("another build of Lather wrote it");
  if (header.state_bytes > file_bytes || file_bytes - header.state_bytes != sizeof header + kChecksumBytes)
    throw CheckpointError("its length is not what its header says");
}

/// The build id among the notes of one segment, "" where it is not there.
std::string id_in_notes(const char* at, std::size_t size) {
  while (size >= sizeof(ElfW(Nhdr))) {
    ElfW(Nhdr) note;
    std::memcpy(&note, at, sizeof note);
    const std::size_t name = (note.n_namesz + 3U) & ~std::size_t{3};
    const std::size_t text = (note.n_descsz + 3U) & ~std::size_t{3};
    if (size - sizeof note < name + text) return {};
    if (note.n_type == NT_GNU_BUILD_ID && note.n_namesz == 4 &&
        std::memcmp(at + sizeof note, "GNU", 4) == 0) {
      std::string id;
      for (std::size_t i = 0; i < note.n_descsz; ++i) {
        char digits[3];
        std::snprintf(digits, sizeof digits, "%02x", static_cast<unsigned char>(at[sizeof note + name + i]));
        id += digits;
      }
      return id;
    }
    at += sizeof note + name + text;
    size -= sizeof note + name + text;
  }
  return {};
}

/// Called for the program first, then for its libraries: the first is all that is wanted.
int find_program_id(dl_phdr_info* program, std::size_t /*size*/, void* to) {
  for (int i = 0; i < program->dlpi_phnum; ++i) {
    const ElfW(Phdr)& segment = program->dlpi_phdr[i];
    if (segment.p_type != PT_NOTE) continue;
    // The loader tells addresses as numbers. NOLINTNEXTLINE(performance-no-int-to-ptr)
    const auto* const notes = reinterpret_cast<const char*>(program->dlpi_addr + segment.p_vaddr);
    std::string id = id_in_notes(notes, segment.p_memsz);
    if (id.empty()) continue;
    *static_cast<std::string*>(to) = std::move(id);
    break;
  }
  return 1;
}

}  // namespace

std::string checkpoint_file_name(std::uint64_t step) {
  char name[48];
  std::snprintf(name, sizeof name, "%012llu.checkpoint", static_cast<unsigned long long>(step));
  return name;
}

std::uint64_t write_checkpoint(const std::filesystem::path& file, std::string_view state) {
  Header header;
  header.build = padded_build();
  header.state_bytes = state.size();
  const std::string_view head(reinterpret_cast<const char*>(&header), sizeof header);
  const std::string checksum = sha256_hex(state);
  write_whole(file, {head, state, checksum});
  return head.size() + state.size() + checksum.size();
}

std::string read_checkpoint(const std::filesystem::path& file) {
  const OwnedFd fd(::open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK));
  struct stat status {};
  if (!fd || ::fstat(fd.get(), &status) != 0)
    throw CheckpointError(std::string("it cannot be opened: ") + std::strerror(errno));
  if (!S_ISREG(status.st_mode)) throw CheckpointError("it is no file");
  Header header;
  read_all(fd.get(), reinterpret_cast<char*>(&header), sizeof header);
  check_header(header, static_cast<std::uint64_t>(status.st_size));
  std::string state(header.state_bytes, '\0');
  read_all(fd.get(), state.data(), state.size());
  std::string checksum(kChecksumBytes, '\0');
  read_all(fd.get(), checksum.data(), checksum.size());
  if (checksum != sha256_hex(state)) throw CheckpointError("its checksum does not fit its bytes");
  return state;
}

const std::string& build_id() {
  static const std::string id = [] {
    std::string found;
    ::dl_iterate_phdr(find_program_id, &found);
    return found.empty() ? std::string(version()) : found;
  }();
  return id;
}

}  // namespace lather::server
