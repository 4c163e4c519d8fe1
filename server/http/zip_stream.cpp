#include "server/http/zip_stream.h"

#include <archive.h>
#include <archive_entry.h>

#include <memory>

namespace lather::server {
namespace {

using Sink = std::function<bool(std::string_view)>;

/// Where the archive's bytes go. Once it is broken they are dropped, and the library is told that all is
/// well: after a failed write it would not free its buffers (20 KB a time).
struct Pipe {
  const Sink& write;
  bool broken = false;
};

la_ssize_t pass_on(archive* /*zip*/, void* to, const void* bytes, std::size_t size) {
  auto& pipe = *static_cast<Pipe*>(to);
  if (!pipe.broken) pipe.broken = !pipe.write({static_cast<const char*>(bytes), size});
  return static_cast<la_ssize_t>(size);
}

bool add(archive* zip, const ZipEntry& entry) {
  const std::optional<std::string> bytes = entry.read();
  if (!bytes) return false;
  const std::unique_ptr<archive_entry, decltype(&archive_entry_free)> header(archive_entry_new(),
                                                                             archive_entry_free);
  archive_entry_set_pathname(header.get(), entry.name.c_str());
  archive_entry_set_size(header.get(), static_cast<la_int64_t>(bytes->size()));
  archive_entry_set_filetype(header.get(), AE_IFREG);
  archive_entry_set_perm(header.get(), 0644);
  if (archive_write_header(zip, header.get()) != ARCHIVE_OK) return false;
  return archive_write_data(zip, bytes->data(), bytes->size()) == static_cast<la_ssize_t>(bytes->size());
}

}  // namespace

bool write_zip(const std::vector<ZipEntry>& entries, const Sink& write) {
  const std::unique_ptr<archive, decltype(&archive_write_free)> zip(archive_write_new(), archive_write_free);
  archive_write_set_format_zip(zip.get());
  archive_write_zip_set_compression_store(zip.get());
  archive_write_set_bytes_in_last_block(zip.get(), 1);
  Pipe pipe{write};
  if (archive_write_open(zip.get(), &pipe, nullptr, pass_on, nullptr) != ARCHIVE_OK) return false;
  for (const ZipEntry& entry : entries) {
    if (!add(zip.get(), entry)) pipe.broken = true;  // nothing that looks like an end may follow
    if (pipe.broken) break;
  }
  return archive_write_close(zip.get()) == ARCHIVE_OK && !pipe.broken;
}

}  // namespace lather::server
