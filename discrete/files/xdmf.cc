// diptych: XDMF files beside HDF5 ones, which ParaView opens
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "discrete/files/xdmf.h"

#include <ostream>
#include <sstream>

#include "discrete/files/csv_file.h"
#include "discrete/files/text_file.h"

namespace diptych::discrete
{
  namespace
  {
    const char *number_words(const XdmfNumber number)
    {
      switch (number)
        {
        case XdmfNumber::real:
          return "NumberType=\"Float\" Precision=\"8\"";
        case XdmfNumber::integer:
          return "NumberType=\"Int\" Precision=\"4\"";
        case XdmfNumber::unsigned_:
          break;
        }
      return "NumberType=\"UInt\" Precision=\"4\"";
    }

    void write_array(std::ostream &out, const std::string &file, const XdmfArray &array)
    {
      out << "<DataItem Format=\"HDF\" " << number_words(array.number) << " Dimensions=\"";
      for (std::size_t k = 0; k < array.extents.size(); ++k)
        out << (k > 0 ? " " : "") << array.extents[k];
      out << "\">" << file << ":/" << array.path << "</DataItem>";
    }

    void write_grid(std::ostream &out, const std::string &file, const XdmfGrid &grid)
    {
      out << "      <Grid Name=\"" << grid.name << "\" GridType=\"Uniform\">\n        <Time Value=\"" << exact_text(grid.time)
          << "\"/>\n        ";
      if (grid.cells.extents.empty())
        out << "<Topology TopologyType=\"Polyvertex\" NumberOfElements=\"" << grid.points.extents[0] << "\"/>\n";
      else
        {
          out << "<Topology TopologyType=\"Quadrilateral_9\" NumberOfElements=\"" << grid.cells.extents[0] << "\">";
          write_array(out, file, grid.cells);
          out << "</Topology>\n";
        }
      out << "        <Geometry GeometryType=\"XYZ\">";
      write_array(out, file, grid.points);
      out << "</Geometry>\n";
      constexpr const char *types[] = {"", "Scalar", "Vector", "Tensor"}; // by the number of extents
      for (const XdmfAttribute &attribute : grid.attributes)
        {
          out << "        <Attribute Name=\"" << attribute.name << "\" AttributeType=\"" << types[attribute.array.extents.size()]
              << "\" Center=\"" << (attribute.of_cells ? "Cell" : "Node") << "\">";
          write_array(out, file, attribute.array);
          out << "</Attribute>\n";
        }
      out << "      </Grid>\n";
    }
  } // namespace

  void write_xdmf(const std::string &path, const std::vector<XdmfCollection> &collections)
  {
    const std::string  file = path.substr(path.find_last_of('/') + 1) + ".h5";
    std::ostringstream out;
    out << "<?xml version=\"1.0\"?>\n<Xdmf Version=\"3.0\">\n  <Domain>\n";
    for (const XdmfCollection &collection : collections)
      {
        out << "    <Grid Name=\"" << collection.name << "\" GridType=\"Collection\" CollectionType=\"Temporal\">\n";
        for (const XdmfGrid &grid : collection.grids)
          write_grid(out, file, grid);
        out << "    </Grid>\n";
      }
    out << "  </Domain>\n</Xdmf>\n";
    write_text(path + ".xdmf", out.str());
  }
} // namespace diptych::discrete
