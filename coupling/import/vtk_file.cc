// diptych: reads arrays from VTK's XML files
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/import/vtk_file.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <map>

#include <pugixml.hpp>
#include <zlib.h>

#include "coupling/import/text_lines.h"
#include "coupling/scene/scene_error.h"
#include "discrete/files/words.h"

namespace diptych::coupling
{
  namespace
  {
    constexpr std::size_t most_bytes = std::size_t(1) << 34; // of one array; larger numbers show a damaged header

    int sextet(const char c)
    {
      if (c >= 'A' && c <= 'Z')
        return c - 'A';
      if (c >= 'a' && c <= 'z')
        return c - 'a' + 26;
      if (c >= '0' && c <= '9')
        return c - '0' + 52;
      return c == '+' ? 62 : c == '/' ? 63 : -1;
    }

    // Reads base64 from a text piece by piece; every piece was encoded separately.
    class Base64
    {
    public:
      Base64(const std::string_view text, const std::string &place)
          : text(text),
            place(place)
      {}

      std::string take(const std::size_t n_bytes)
      {
        const std::size_t n_characters = (n_bytes + 2) / 3 * 4;
        if (n_bytes > most_bytes || at + n_characters > text.size())
          throw SceneError(place + " is truncated");
        std::string   bytes;
        std::uint32_t bits = 0;
        for (std::size_t k = 0; k < n_characters; ++k)
          {
            const char c     = text[at + k];
            const int  value = c == '=' ? 0 : sextet(c);
            if (value < 0)
              throw SceneError(place + " is damaged: not base64");
            bits = bits << 6 | std::uint32_t(value);
            if (k % 4 == 3)
              for (const int shift : {16, 8, 0})
                bytes += char(bits >> shift & 255);
          }
        at += n_characters;
        bytes.resize(n_bytes);
        return bytes;
      }

    private:
      std::string_view text;
      std::string      place;
      std::size_t      at = 0;
    };

    std::uint64_t head_number(const std::string &bytes, const std::size_t k, const std::size_t width)
    {
      std::uint64_t value = 0;
      std::memcpy(&value, bytes.data() + k * width, width);
      return value;
    }

    std::string inflate_block(const std::string &packed, const std::size_t n_bytes, const std::string &place)
    {
      if (n_bytes > most_bytes)
        throw SceneError(place + " has a damaged header");
      std::string bytes(n_bytes, '\0');
      uLongf      size = uLongf(n_bytes);
      if (uncompress(reinterpret_cast<Bytef *>(bytes.data()), &size, reinterpret_cast<const Bytef *>(packed.data()),
                     uLong(packed.size())) != Z_OK ||
          size != n_bytes)
        throw SceneError(place + " is damaged: decompression failed");
      return bytes;
    }

    // Header: number of blocks, their size, size of the last (0: like the others), packed size of each. Without compression:
    // the size.
    std::string bytes_of(const std::string_view text, const bool compressed, const std::size_t width, const std::string &place)
    {
      Base64 encoded(text, place);
      if (!compressed)
        {
          // size and data are one piece
          const std::uint64_t n = head_number(Base64(text, place).take(width), 0, width);
          if (n > most_bytes)
            throw SceneError(place + " has a damaged header");
          return encoded.take(width + n).substr(width);
        }
      const std::size_t n_blocks = head_number(Base64(text, place).take(3 * width), 0, width);
      if (n_blocks > text.size())
        throw SceneError(place + " has a damaged header");
      const std::string head  = encoded.take((3 + n_blocks) * width);
      std::size_t       total = 0;
      for (std::size_t k = 0; k < n_blocks; ++k)
        total += head_number(head, 3 + k, width) > most_bytes ? most_bytes : head_number(head, 3 + k, width);
      const std::string packed = encoded.take(total);
      const std::size_t size = head_number(head, 1, width), last = head_number(head, 2, width);
      std::string       bytes;
      for (std::size_t k = 0, at = 0; k < n_blocks; ++k)
        {
          const std::size_t packed_size = head_number(head, 3 + k, width);
          bytes += inflate_block(packed.substr(at, packed_size), k + 1 == n_blocks && last > 0 ? last : size, place);
          at += packed_size;
        }
      return bytes;
    }

    template <class T> void append_as(const std::string &bytes, std::vector<double> &values)
    {
      for (std::size_t k = 0; k + sizeof(T) <= bytes.size(); k += sizeof(T))
        {
          T value;
          std::memcpy(&value, bytes.data() + k, sizeof value);
          values.push_back(double(value));
        }
    }

    std::vector<double> numbers_in(const std::string &bytes, const std::string &type, const std::string &place)
    {
      std::vector<double>                                                               values;
      const std::map<std::string, void (*)(const std::string &, std::vector<double> &)> readers = {
        {"Float64", append_as<double>},
        {"Float32", append_as<float>},
        {"Int64", append_as<std::int64_t>},
        {"Int32", append_as<std::int32_t>},
        {"UInt8", append_as<std::uint8_t>}};
      const auto reader = readers.find(type);
      if (reader == readers.end())
        throw SceneError(place + " is of type " + type + "; supported are Float64, Float32, Int64, Int32 and UInt8");
      reader->second(bytes, values);
      return values;
    }

    std::vector<double> numbers_in_text(const std::string &text, const TextLines &file, const std::string &place)
    {
      std::vector<double> values;
      std::string         flat = text;
      std::replace(flat.begin(), flat.end(), '\n', ' ');
      for (const std::string_view word : words_of(flat))
        values.push_back(file.number(word, place));
      return values;
    }
  } // namespace

  VtkFile::VtkFile(const std::string &file)
      : path(file)
  {
    const TextLines              checked(path); // checks that the file exists, is a text and ends with a complete line
    pugi::xml_document           document;
    const pugi::xml_parse_result parsed = document.load_file(path.c_str());
    if (!parsed)
      throw SceneError(path + ": invalid XML from byte " + std::to_string(parsed.offset) + " on: " + parsed.description());
    const pugi::xml_node root = document.child("VTKFile");
    if (std::string(root.attribute("byte_order").value()) != "LittleEndian")
      throw SceneError(path + ": is not a VTKFile of byte_order LittleEndian");
    compressed                = root.attribute("compressor");
    wide_header               = std::string(root.attribute("header_type").value()) == "UInt64";
    const pugi::xml_node data = root.child(root.attribute("type").value()), piece = data.child("Piece");
    if (!piece || piece.next_sibling("Piece"))
      throw SceneError(path + ": needs one Piece, but has " + (piece ? "several" : "none"));
    for (const pugi::xml_node &element : piece.children())
      for (const pugi::xml_node &array : element.children("DataArray"))
        entries.push_back({element.name(), array.attribute("Name").value(), array.attribute("type").value(),
                           array.attribute("format").value(), std::string(array.text().get()),
                           array.attribute("NumberOfComponents").as_uint(1),
                           std::size_t(array.attribute("offset").as_ullong(0))});
    const pugi::xml_node all = root.child("AppendedData");
    const std::string    raw = all.text().get();
    if (all && std::string(all.attribute("encoding").value()) != "base64")
      throw SceneError(path + ": AppendedData has an unsupported encoding; only base64 is supported");
    if (const std::size_t mark = raw.find('_'); all && mark != std::string::npos)
      appended = raw.substr(mark + 1);
  }

  bool VtkFile::has(const std::string &element, const std::string &name) const
  {
    return std::any_of(entries.begin(), entries.end(), [&](const Entry &e) { return e.element == element && e.name == name; });
  }

  VtkArray VtkFile::read(const std::string &element, const std::string &name, const std::size_t components) const
  {
    const std::string place = path + ": array " + element + "/" + name;
    const auto        found = std::find_if(entries.begin(), entries.end(),
                                           [&](const Entry &e) { return e.element == element && e.name == name; });
    if (found == entries.end())
      throw SceneError(place + " is missing");
    if (found->components != components)
      throw SceneError(place + " has " + std::to_string(found->components) + " components, not " + std::to_string(components));
    VtkArray array{name, components, {}};
    if (found->format == "ascii")
      array.values = numbers_in_text(found->text, TextLines(path), place);
    else
      {
        const bool is_appended = found->format == "appended";
        if (is_appended && found->offset >= appended.size())
          throw SceneError(place + " begins beyond the appended data; the file is truncated");
        const std::string_view text =
          is_appended
            ? std::string_view(appended).substr(found->offset)
            : discrete::trimmed(
                std::string_view(found->text).substr(std::min(found->text.size(), found->text.find_first_not_of(" \n\t"))));
        array.values = numbers_in(bytes_of(text, compressed, wide_header ? 8 : 4, place), found->type, place);
      }
    if (array.values.size() % components != 0)
      throw SceneError(place + " does not contain complete rows");
    for (const double value : array.values)
      if (!std::isfinite(value))
        throw SceneError(place + " contains a number that is not finite");
    return array;
  }
} // namespace diptych::coupling
