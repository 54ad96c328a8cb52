// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef FLATTEN_MESH_PNG_H
#define FLATTEN_MESH_PNG_H

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace flattening {

// A picture with at most 256 colours: one byte a pixel, rows from the top.
struct Palette_image
{
  typedef std::array<unsigned char, 4> Color; // red, green, blue, opacity

  std::uint32_t width, height;
  std::vector<Color> palette;
  std::vector<unsigned char> pixels;

  Palette_image(std::uint32_t width, std::uint32_t height, std::vector<Color> palette)
    : width(width), height(height), palette(std::move(palette)),
      pixels(std::size_t(width) * height, 0)
  {}
};

inline void append_big_endian(std::string& bytes, std::uint32_t x)
{
  for(int shift = 24; shift >= 0; shift -= 8)
    bytes += static_cast<char>((x >> shift) & 255);
}

// The check sum of PNG's chunks (CRC-32 of ISO 3309).
inline std::uint32_t crc32(const char* first, const char* last)
{
  static const std::array<std::uint32_t, 256> table = []
  {
    std::array<std::uint32_t, 256> t;
    for(std::uint32_t n = 0; n < 256; ++n)
    {
      t[n] = n;
      for(int bit = 0; bit < 8; ++bit)
        t[n] = (t[n] & 1) ? 0xedb88320u ^ (t[n] >> 1) : t[n] >> 1;
    }
    return t;
  }();
  std::uint32_t sum = 0xffffffffu;
  for(; first != last; ++first)
    sum = table[(sum ^ static_cast<unsigned char>(*first)) & 255] ^ (sum >> 8);
  return ~sum;
}

// The check sum of zlib's streams.
inline std::uint32_t adler32(const std::string& bytes)
{
  std::uint32_t a = 1, b = 0;
  for(char c : bytes)
  {
    a = (a + static_cast<unsigned char>(c)) % 65521;
    b = (b + a) % 65521;
  }
  return (b << 16) | a;
}

// A zlib stream of stored blocks: nothing is compressed.
inline std::string stored_zlib_stream(const std::string& bytes)
{
  const std::size_t block = 65535;
  std::string stream = "\x78\x01";
  for(std::size_t i = 0; i < bytes.size(); i += block)
  {
    const std::size_t n = (std::min)(block, bytes.size() - i);
    stream += static_cast<char>(i + n == bytes.size());
    stream += static_cast<char>(n & 255);
    stream += static_cast<char>(n >> 8);
    stream += static_cast<char>(~n & 255);
    stream += static_cast<char>((~n >> 8) & 255);
    stream.append(bytes, i, n);
  }
  append_big_endian(stream, adler32(bytes));
  return stream;
}

inline void append_png_chunk(std::string& png, const char* type, const std::string& data)
{
  append_big_endian(png, static_cast<std::uint32_t>(data.size()));
  const std::size_t begin = png.size();
  png += type;
  png += data;
  append_big_endian(png, crc32(png.data() + begin, png.data() + png.size()));
}

// How many bits a pixel takes.
inline std::uint32_t bits_of_pixel(const Palette_image& image)
{
  return image.palette.size() <= 2 ? 1 : image.palette.size() <= 16 ? 4 : 8;
}

// A row of pixels in bytes, the first pixel in the highest bits.
inline void append_png_row(std::string& rows, const Palette_image& image, std::size_t y)
{
  const std::uint32_t bits = bits_of_pixel(image), in_a_byte = 8 / bits;
  rows += '\0'; // no filter
  for(std::uint32_t x = 0; x < image.width; x += in_a_byte)
  {
    std::uint32_t byte = 0;
    for(std::uint32_t i = 0; i < in_a_byte && x + i < image.width; ++i)
      byte |= std::uint32_t(image.pixels[y * image.width + x + i]) << (8 - bits * (i + 1));
    rows += static_cast<char>(byte);
  }
}

// The file of the picture in the format PNG (ISO/IEC 15948).
inline std::string png_file(const Palette_image& image)
{
  std::string header, colors, opacities, rows;
  append_big_endian(header, image.width);
  append_big_endian(header, image.height);
  header += static_cast<char>(bits_of_pixel(image));
  header += std::string("\x03\x00\x00\x00", 4); // with a palette
  for(const Palette_image::Color& c : image.palette)
  {
    colors.append(c.begin(), c.begin() + 3);
    opacities += static_cast<char>(c[3]);
  }
  for(std::size_t y = 0; y < image.height; ++y)
    append_png_row(rows, image, y);

  std::string png = "\x89PNG\r\n\x1a\n";
  append_png_chunk(png, "IHDR", header);
  append_png_chunk(png, "PLTE", colors);
  append_png_chunk(png, "tRNS", opacities);
  append_png_chunk(png, "IDAT", stored_zlib_stream(rows));
  append_png_chunk(png, "IEND", "");
  return png;
}

} // namespace flattening

#endif // FLATTEN_MESH_PNG_H
