#include "cli/pictures.h"

#include <numbers>

#include "pillowmesh/io/io.h"
#include "pillowmesh/mesh/number.h"

#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_STATIC
#define STBI_ONLY_PNG
#define STBI_ONLY_JPEG
#define STBI_ONLY_BMP
#define STBI_ONLY_PNM
#define STBI_NO_STDIO
#if defined(__GNUC__)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#endif
#include <stb/stb_image.h>
#if defined(__GNUC__)
#pragma GCC diagnostic pop
#endif

namespace pillowmesh::cli {

Expected<GrayImage> read_image(const std::string& path) {
  auto bytes = read_file(path);
  if (!bytes) return bytes.status();
  GrayImage image;
  int channels = 0;
  stbi_uc* pixels = stbi_load_from_memory(reinterpret_cast<const stbi_uc*>(bytes->data()),
                                          static_cast<int>(bytes->size()), &image.width, &image.height, &channels, 1);
  if (pixels == nullptr)
    return Status::bad_input(path + ": not an image that can be read (" + stbi_failure_reason() +
                             "); known are PNG, JPEG, BMP and binary PNM");
  const std::size_t count = static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
  image.values.assign(pixels, pixels + count);
  stbi_image_free(pixels);
  for (float& v : image.values) v /= 255.0F;
  return image;
}

Expected<std::vector<Dab>> read_sketch(const std::string& path) {
  auto bytes = read_file(path);
  if (!bytes) return bytes.status();
  std::vector<Dab> dabs;
  std::string_view text(bytes->data(), bytes->size());
  for (int line = 1; !text.empty(); ++line) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    std::string_view rest = text.substr(0, std::min(end, text.find('#')));
    text.remove_prefix(std::min(end + 1, text.size()));
    std::vector<double> numbers;
    bool good = true;
    while (true) {
      const std::size_t from = rest.find_first_not_of(" \t\r,;");
      if (from == std::string_view::npos) break;
      rest.remove_prefix(from);
      const std::size_t length = std::min(rest.find_first_of(" \t\r,;"), rest.size());
      good = parse_double(rest.substr(0, length), numbers.emplace_back()) && good;
      rest.remove_prefix(length);
    }
    if (numbers.empty()) continue;
    if (!good || (numbers.size() != 4 && numbers.size() != 6))
      return Status::bad_input(
          path + ", line " + std::to_string(line) +
          ": a dab is x y radius size, and for stretched cells angle (degrees) and stretch as well");
    Dab dab{numbers[0], numbers[1], numbers[2], numbers[3]};
    if (numbers.size() == 6) {
      dab.angle = numbers[4] * std::numbers::pi / 180.0;
      dab.stretch = numbers[5];
    }
    dabs.push_back(dab);
  }
  if (dabs.empty()) return Status::bad_input(path + ": there is no dab in the sketch");
  return dabs;
}

}  // namespace pillowmesh::cli
