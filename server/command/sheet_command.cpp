#include <algorithm>
#include <cstdio>

#include "render/contact_sheet.h"
#include "server/artifacts/whole_file.h"
#include "server/command/commands.h"
#include "server/command/scene_source.h"
#include "sim/error.h"

namespace lather::server {
namespace {

namespace fs = std::filesystem;

/// The pictures in a directory, by name.
std::vector<fs::path> pictures_in(const fs::path& run) {
  const fs::path frames = run / "frames";
  std::vector<fs::path> files;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(frames, error))
    if (entry.path().extension() == ".png") files.push_back(entry.path());
  if (files.empty())
    throw InputError({{"", run.string(), "a directory that 'lather run' or 'lather render' made",
                       "There are no pictures in " + frames.string() + "."}});
  std::sort(files.begin(), files.end());
  return files;
}

/// The row's title and the picture's time are read from the PNG's texts.
void add_picture(render::SheetRow& row, const fs::path& file, int width) {
  const std::string bytes = read_text(file);
  render::Image image;
  double time = 0;
  try {
    image = render::decode_png(bytes);
    for (const auto& [keyword, text] : render::png_text(bytes)) {
      if (keyword == "Title") row.title = text;
      if (keyword == "lather:time") time = std::stod(text);
    }
  } catch (const std::exception& e) {
    throw InputError({{"", file.string(), "a picture that Lather made", e.what()}});
  }
  if (image.width < width)
    throw InputError({{"", "--width " + std::to_string(width), "1 to " + std::to_string(image.width),
                       "The pictures in " + file.parent_path().string() + " are smaller than that."}});
  row.pictures.push_back({std::move(image), time});
}

}  // namespace

int sheet_command(const SheetOptions& options) {
  std::vector<render::SheetRow> rows;
  for (const fs::path& run : options.runs) {
    const std::vector<fs::path> files = pictures_in(run);
    render::SheetRow row;
    const auto wanted = std::min(static_cast<std::size_t>(options.pictures), files.size());
    for (std::size_t i = 0; i < wanted; ++i) {
      const std::size_t last = files.size() - 1;
      add_picture(row, files[wanted == 1 ? last : i * last / (wanted - 1)], options.width);
    }
    rows.push_back(std::move(row));
  }
  write_whole(options.out, render::encode_png(render::contact_sheet(rows, options.width), {}));
  std::printf("%s\n", options.out.c_str());
  return 0;
}

}  // namespace lather::server
