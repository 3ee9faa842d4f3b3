// diptych: mesh files are checked before gmsh sees them
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "continuum/mesh/msh_text.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <map>
#include <unordered_map>
#include <utility>
#include <vector>

#include "continuum/mesh/msh_lines.h"
#include "continuum/mesh/quad_mesh.h"

namespace diptych::continuum
{
  namespace
  {
    constexpr std::uint64_t largest_tag = 2147483647; // gmsh's tags are ints, wherever the file is read
    constexpr std::uint64_t any_number  = std::numeric_limits<std::uint64_t>::max();
    constexpr std::uint64_t type_line = 1, type_quadrilateral = 3, largest_type = 140; // elements of the format

    struct MshNode
    {
      double      x, y, z;
      std::size_t line;
    };

    // Type, number of the group or the entity where it counts, nodes in ascending order.
    using ElementKey = std::array<std::uint64_t, 6>;

    struct MshScan
    {
      MshLines                                       lines;
      std::unordered_map<std::uint64_t, MshNode>     nodes;
      std::unordered_map<std::uint64_t, std::size_t> elements; // their lines
      std::map<ElementKey, std::size_t>              once;     // their lines
      bool                                           has_nodes = false, has_elements = false;
    };

    // An element whose nodes are the last words of the present line.
    struct MshElement
    {
      std::uint64_t tag, type, group;
      std::size_t   first_node; // word
    };

    // Of the types of the format up to the second order, and the point; 0 of all others.
    std::size_t n_nodes_of(const std::uint64_t type)
    {
      constexpr std::array<std::size_t, 20> counts = {0, 2, 3, 4, 4, 8, 6, 5, 3, 6, 9, 10, 27, 18, 14, 1, 8, 20, 15, 13};
      return type < counts.size() ? counts[type] : 0;
    }

    void expect_end(MshScan &scan, const std::string &section)
    {
      scan.lines.next_of(("$" + section).c_str());
      if (scan.lines.line().substr(0, section.size() + 4) != "$End" + section)
        scan.lines.refuse("$End" + section + " must stand here: the counts before it do not fit");
    }

    void add_node(MshScan &scan, const std::uint64_t tag, const std::size_t line, const std::size_t first_word)
    {
      const MshLines &in = scan.lines;
      const MshNode   node{in.coordinate(first_word, tag), in.coordinate(first_word + 1, tag), in.coordinate(first_word + 2, tag),
                         line};
      if (const auto [other, is_new] = scan.nodes.emplace(tag, node); !is_new)
        in.refuse_at(line,
                     "node " + std::to_string(tag) + " is given twice, first in line " + std::to_string(other->second.line));
    }

    void check_shape(const MshScan &scan, const MshElement &element)
    {
      std::array<Eigen::Vector2d, 4> corners;
      for (std::size_t k = 0; k < 4; ++k)
        {
          const auto    tag  = scan.lines.integer(element.first_node + k, "a node", 1, largest_tag);
          const MshNode node = scan.nodes.at(tag);
          if (node.z != 0)
            return; // outside of the plane: judged with the made mesh
          corners[k] = {node.x, node.y};
        }
      if (turn_of(corners) == Turn::folded)
        scan.lines.refuse("the quadrilateral " + std::to_string(element.tag) + " is folded, concave or flat");
    }

    void add_element(MshScan &scan, const MshElement &element)
    {
      const MshLines &in = scan.lines;
      if (const auto [other, is_new] = scan.elements.emplace(element.tag, in.number()); !is_new)
        in.refuse("element " + std::to_string(element.tag) + " is given twice, first in line " + std::to_string(other->second));
      for (std::size_t k = element.first_node; k < in.n_words(); ++k)
        if (const auto node = in.integer(k, "a node", 1, largest_tag); scan.nodes.count(node) == 0)
          in.refuse("element " + std::to_string(element.tag) + " names node " + std::to_string(node) +
                    ", which the file does not hold");
      const auto n = in.n_words() - element.first_node;
      if (n != n_nodes_of(element.type))
        in.refuse("an element of type " + std::to_string(element.type) + " does not have " + std::to_string(n) +
                  " nodes, or is unknown");
      if (element.type != type_line && element.type != type_quadrilateral)
        return; // a mere point, or refused with its name later
      ElementKey key{element.type, element.type == type_line ? element.group : 0};
      for (std::size_t k = 0; k < n; ++k)
        key[2 + k] = in.integer(element.first_node + k, "a node", 1, largest_tag);
      std::sort(key.begin() + 2, key.end());
      if (element.type == type_quadrilateral)
        check_shape(scan, element);
      if (const auto [other, is_new] = scan.once.emplace(key, in.number()); !is_new)
        in.refuse((n == 4 ? "two cells overlap: " : "") + std::string("element ") + std::to_string(element.tag) +
                  " has the nodes of the element in line " + std::to_string(other->second));
    }

    // MSH 2.2: the number of nodes; lines of tag, x, y, z and, in $ParametricNodes, the place on an entity.
    void read_nodes_2(MshScan &scan, const std::string &section)
    {
      MshLines &in = scan.lines;
      in.next_of(section.c_str());
      in.expect_words(1, "the number of nodes");
      const auto count = in.integer(0, "the number of nodes", 0, any_number);
      in.expect_room(count);
      for (std::uint64_t k = 0; k < count; ++k)
        {
          in.next_of(section.c_str());
          in.expect_words(4, "tag and three coordinates of a node", section != "Nodes");
          add_node(scan, in.integer(0, "the tag of a node", 1, largest_tag), in.number(), 1);
        }
    }

    // MSH 2.2: the number of elements; lines of tag, type, number of attributes, attributes (the first is the group), nodes.
    void read_elements_2(MshScan &scan)
    {
      MshLines &in = scan.lines;
      in.next_of("Elements");
      in.expect_words(1, "the number of elements");
      const auto count = in.integer(0, "the number of elements", 0, any_number);
      in.expect_room(count);
      for (std::uint64_t k = 0; k < count; ++k)
        {
          in.next_of("Elements");
          in.expect_words(4, "tag, type, number of attributes, attributes and nodes of an element", true);
          const auto tag    = in.integer(0, "the tag of an element", 1, largest_tag);
          const auto type   = in.integer(1, "the type of an element", 1, largest_type);
          const auto n_more = in.integer(2, "the number of attributes", 0, in.n_words() - 4);
          for (std::size_t a = 0; a < std::min<std::uint64_t>(n_more, 2); ++a)
            (void)in.integer(3 + a, a == 0 ? "the physical group" : "the entity", 0, largest_tag);
          add_element(scan, {tag, type, n_more > 0 ? in.integer(3, "the physical group", 0, largest_tag) : 0, 3 + n_more});
        }
    }

    // Head of a section of MSH 4.1: numbers of blocks and of what they hold, least and largest tag.
    std::array<std::uint64_t, 4> head_of_blocks(MshScan &scan, const char *section)
    {
      MshLines &in = scan.lines;
      in.next_of(section);
      in.expect_words(4, "numbers of blocks and of what they hold, least and largest tag");
      const std::array<std::uint64_t, 4> head = {
        in.integer(0, "the number of blocks", 0, any_number), in.integer(1, "the number of what they hold", 0, any_number),
        in.integer(2, "the least tag", 0, largest_tag), in.integer(3, "the largest tag", 0, largest_tag)};
      in.expect_room(head[0]), in.expect_room(head[1]);
      return head;
    }

    // Head of a block: dimension, entity, one number more, number of what it holds, which is at most `left` and taken from it.
    std::array<std::uint64_t, 4> head_of_block(MshScan &scan, const char *section, std::uint64_t &left)
    {
      MshLines &in = scan.lines;
      in.next_of(section);
      in.expect_words(4, "head of a block");
      const std::array<std::uint64_t, 4> head = {in.integer(0, "the dimension", 0, 3),
                                                 in.integer(1, "the entity", 0, largest_tag),
                                                 in.integer(2, "the third number of a block", 0, largest_type),
                                                 in.integer(3, "the number of what the block holds", 0, left)};
      left -= head[3];
      return head;
    }

    void read_nodes_4(MshScan &scan)
    {
      MshLines &in                          = scan.lines;
      auto [n_blocks, left, least, largest] = head_of_blocks(scan, "Nodes");
      for (std::uint64_t block = 0; block < n_blocks; ++block)
        {
          const auto                                         head = head_of_block(scan, "Nodes", left);
          std::vector<std::pair<std::uint64_t, std::size_t>> tags; // and their lines
          for (std::uint64_t k = 0; k < head[3]; ++k)
            {
              in.next_of("Nodes");
              in.expect_words(1, "the tag of a node");
              tags.emplace_back(in.integer(0, "the tag of a node", std::max<std::uint64_t>(1, least), largest), in.number());
            }
          for (const auto &[tag, line] : tags)
            {
              in.next_of("Nodes");
              in.expect_words(3, "coordinates of a node", head[2] == 1);
              add_node(scan, tag, line, 0);
            }
        }
      if (left > 0)
        in.refuse("the blocks hold " + std::to_string(left) + " nodes fewer than the section says");
    }

    void read_elements_4(MshScan &scan)
    {
      MshLines &in                          = scan.lines;
      auto [n_blocks, left, least, largest] = head_of_blocks(scan, "Elements");
      for (std::uint64_t block = 0; block < n_blocks; ++block)
        {
          const auto head = head_of_block(scan, "Elements", left);
          for (std::uint64_t k = 0; k < head[3]; ++k)
            {
              in.next_of("Elements");
              in.expect_words(2, "tag and nodes of an element", true);
              add_element(
                scan, {in.integer(0, "the tag of an element", std::max<std::uint64_t>(1, least), largest), head[2], head[1], 1});
            }
        }
      if (left > 0)
        in.refuse("the blocks hold " + std::to_string(left) + " elements fewer than the section says");
    }

    // A section whose lines we do not read. Those that begin with counts have as many lines.
    void pass_over(MshScan &scan, const std::string &section)
    {
      MshLines     &in     = scan.lines;
      std::uint64_t n_more = 0;
      in.next_of(section.c_str());
      if (section == "PhysicalNames" || section == "Entities")
        for (std::size_t k = 0; k < in.n_words() && in.line()[0] != '$'; ++k)
          n_more += in.integer(k, "a count", 0, largest_tag);
      in.expect_room(n_more);
      std::uint64_t n = 0;
      for (; in.line().substr(0, section.size() + 4) != "$End" + section; ++n)
        in.next_of(section.c_str());
      if (n_more > 0 && n != n_more + 1)
        in.refuse("$" + section + " says " + std::to_string(n_more) + " lines, but holds " + std::to_string(n - 1));
    }

    // Whether the version is 4.1, not 2.2.
    bool read_format(MshScan &scan)
    {
      MshLines &in = scan.lines;
      in.next_of("MeshFormat");
      in.expect_words(3, "version, 0 for ASCII, size of a number");
      if (in.word(0) != "2.2" && in.word(0) != "4.1")
        in.refuse("the version of the format must be 2.2 or 4.1");
      if (in.word(1) != "0")
        in.refuse("binary mesh files are not read; save it as ASCII (in gmsh Mesh.Binary = 0)");
      const bool is_4_1 = in.word(0) == "4.1";
      expect_end(scan, "MeshFormat");
      return is_4_1;
    }

    void read_section(MshScan &scan, const std::string &section, const bool is_4_1)
    {
      const bool holds_nodes = section == "Nodes" || section == "ParametricNodes";
      if (!holds_nodes && section != "Elements")
        return pass_over(scan, section);
      if ((holds_nodes ? scan.has_nodes : scan.has_elements))
        scan.lines.refuse("the section $" + section + " is given twice");
      (holds_nodes ? scan.has_nodes : scan.has_elements) = true;
      if (holds_nodes)
        is_4_1 ? read_nodes_4(scan) : read_nodes_2(scan, section);
      else
        is_4_1 ? read_elements_4(scan) : read_elements_2(scan);
      expect_end(scan, section);
    }

    bool is_for_gmsh(const std::string &section)
    {
      for (const char *name :
           {"MeshFormat", "PhysicalNames", "Entities", "PartitionedEntities", "Nodes", "ParametricNodes", "Elements"})
        if (section == name)
          return true;
      return false;
    }
  } // namespace

  std::string checked_msh_text(const std::string &file, const std::string &text)
  {
    MshScan     scan{{file, text}, {}, {}, {}, false, false};
    MshLines   &in = scan.lines;
    std::string for_gmsh;
    bool        has_format = false, is_4_1 = false;
    while (in.next())
      {
        const std::size_t begin   = in.line().data() - text.data();
        const std::string section = in.word(0)[0] == '$' && in.line()[0] == '$' ? std::string(in.word(0).substr(1)) : "";
        if (!has_format && section != "MeshFormat" && section != "Comments")
          in.refuse("a .msh file must begin with $MeshFormat");
        if (section.empty() || section.substr(0, 3) == "End" || (has_format && section == "MeshFormat"))
          in.refuse("belongs to no section");
        if (section == "MeshFormat")
          has_format = true, is_4_1 = read_format(scan);
        else
          read_section(scan, section, is_4_1);
        if (is_for_gmsh(section))
          for_gmsh += text.substr(begin, in.line().data() + in.line().size() - text.data() - begin) + "\n";
      }
    if (!has_format)
      in.refuse_at(1, "the file is empty; a .msh file must begin with $MeshFormat");
    return for_gmsh;
  }
} // namespace diptych::continuum
