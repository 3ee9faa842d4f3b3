// diptych: reads LMGC90: BODIES.DAT with DOF and Vloc_Rloc files, or with its HDF5 file
// SPDX-License-Identifier: LGPL-2.1-or-later
#include <algorithm>
#include <cmath>
#include <filesystem>

#include "coupling/import/lmgc90_bodies.h"
#include "coupling/import/lmgc90_hdf5.h"
#include "coupling/import/lmgc90_text.h"
#include "coupling/import/readers.h"
#include "coupling/import/wall_table.h"
#include "coupling/scene/scene_error.h"
#include "discrete/files/csv_file.h"

namespace diptych::coupling
{
  namespace
  {
    // "$steps N time= T"
    void read_instant(TextLines &lines, ForeignFrame &frame)
    {
      while (!lines.at_end())
        {
          const std::string_view line = lines.take("'$steps'");
          if (line.substr(0, 6) != "$steps")
            continue;
          const auto words = words_of(line);
          if (words.size() < 3)
            lines.refuse("expected '$steps N time= T'");
          frame.step = lines.whole(words[1], "the step");
          frame.time = lmgc90_field(lines, line, "time=");
          return;
        }
      lines.refuse("the file ends without '$steps'");
    }

    std::map<long, Lmgc90Motion> read_motions(const std::string &path, ForeignFrame &frame)
    {
      TextLines                    lines(path);
      std::map<long, Lmgc90Motion> motions;
      read_instant(lines, frame);
      Lmgc90Motion *motion = nullptr;
      while (!lines.at_end())
        {
          const std::string_view line = lines.take("a body");
          if (const long number = lmgc90_body_number(lines, line); number > 0)
            motion = &motions[number];
          if (motion == nullptr || line.find("X(1)=") == std::string_view::npos)
            continue;
          for (const int k : {0, 1, 2})
            motion->displacement[k] = lmgc90_field(lines, line, "X(" + std::to_string(k + 1) + ")=");
          const std::string_view next = lines.take("V(1), V(2) and V(3)");
          for (const int k : {0, 1, 2})
            motion->velocity[k] = lmgc90_field(lines, next, "V(" + std::to_string(k + 1) + ")=");
        }
      return motions;
    }

    Lmgc90Contact read_contact(TextLines &lines)
    {
      (void)lines.take("the names of the columns");
      const auto words = words_of(lines.take("candidate and antagonist"));
      if (words.size() < 11 || words[0] != "RBDY2" || words[5] != "RBDY2")
        lines.refuse("expected RBDY2 N DISKx K law RBDY2 N DISKx or JONCx K status");
      Lmgc90Contact contact;
      contact.line           = lines.line();
      contact.candidate      = lines.whole(words[1], "the candidate");
      contact.antagonist     = lines.whole(words[6], "the antagonist");
      contact.slides         = words[9].substr(0, 2) == "sl";
      const auto       field = [&](const std::string_view line, const char *name) { return lmgc90_field(lines, line, name); };
      std::string_view line  = lines.take("rlt/H and rln/H");
      contact.tangential     = field(line, "rlt/H");
      contact.normal         = field(line, "rln/H");
      (void)lines.take("vlt and vln");
      contact.gap       = field(lines.take("gapTT"), "gapTT");
      line              = lines.take("n(1) and n(2)");
      contact.direction = {field(line, "n(1)="), field(line, "n(2)=")};
      if (!is_unit(contact.direction))
        lines.refuse("n(1), n(2) are not a unit normal; the sum of their squares is " +
                     discrete::exact_text(contact.direction.squaredNorm()));
      line          = lines.take("coo1 and coo2");
      contact.point = {field(line, "coo1="), field(line, "coo2=")};
      return contact;
    }

    // Rows without a force are close pairs and not contacts.
    void read_contacts(const std::string &path, const std::map<long, int> &walls, ForeignFrame &frame)
    {
      TextLines    lines(path);
      ForeignFrame instant;
      read_instant(lines, instant);
      if (instant.step != frame.step || std::abs(*instant.time - *frame.time) > 1e-9 * std::abs(*frame.time))
        lines.refuse("step " + std::to_string(*instant.step) + " differs from that of " + frame.grain_file + " (" +
                     std::to_string(*frame.step) + "): the frames do not match");
      frame.has_contacts = true;
      frame.contact_file = path;
      while (!lines.at_end())
        {
          const std::string_view line = lines.take("a contact");
          if (line.substr(0, 6) != "$icdan")
            continue;
          const Lmgc90Contact contact = read_contact(lines);
          if (contact.normal > 0)
            frame.contacts.push_back(foreign_contact(contact, walls));
        }
    }

    struct Lmgc90Files
    {
      std::string                        bodies, behaviours, hdf5;
      std::map<std::string, std::string> motions, contacts; // by the text after DOF. and Vloc_Rloc.
      std::vector<std::string>           wall_tables, unused;
    };

    Lmgc90Files sorted_lmgc90(const ForeignOptions &options)
    {
      Lmgc90Files files;
      for (const std::string &path : options.files)
        {
          const std::string name = std::filesystem::path(path).filename().string(),
                            tail = name.substr(std::min(name.size(), name.find('.') + 1));
          if (name.rfind("BODIES.", 0) == 0)
            files.bodies = path;
          else if (name.rfind("BULK_BEHAV.", 0) == 0)
            files.behaviours = path;
          else if (name.rfind("DOF.", 0) == 0)
            files.motions[tail] = path;
          else if (name.rfind("Vloc_Rloc.", 0) == 0)
            files.contacts[tail] = path;
          else if (std::filesystem::path(path).extension() == ".h5")
            files.hdf5 = path;
          else if (name.rfind("DRV_DOF.", 0) == 0 || name.rfind("TACT_BEHAV.", 0) == 0)
            files.unused.push_back(path);
          else if (is_wall_table(path))
            files.wall_tables.push_back(path);
          else
            throw SceneError(path + ": is none of BODIES.*, BULK_BEHAV.*, DOF.*, Vloc_Rloc.*, *.h5, nor a wall table");
        }
      if (files.bodies.empty())
        throw SceneError("import lmgc90: BODIES.DAT is missing; it contains radii and walls");
      if (files.motions.empty() && files.hdf5.empty())
        throw SceneError("import lmgc90: DOF.OUT.* or a .h5 file is missing; they contain the positions of the bodies");
      for (const auto &[tail, path] : files.contacts)
        if (files.motions.count(tail) == 0)
          throw SceneError(path + ": there is no DOF." + tail + ": the frames do not match");
      return files;
    }
  } // namespace

  ForeignSample read_lmgc90(const ForeignOptions &options)
  {
    const Lmgc90Files  files  = sorted_lmgc90(options);
    const Lmgc90Bodies bodies = read_lmgc90_bodies(files.bodies);
    const auto densities = files.behaviours.empty() ? std::map<std::string, double>() : read_lmgc90_densities(files.behaviours);
    const auto walls     = lmgc90_walls(bodies);
    ForeignSample sample;
    sample.format = "lmgc90";
    for (const auto &[tail, path] : files.motions)
      {
        ForeignFrame frame;
        frame.name       = tail;
        frame.grain_file = path;
        place_lmgc90_bodies(bodies, densities, read_motions(path, frame), frame);
        if (const auto contacts = files.contacts.find(tail); contacts != files.contacts.end())
          read_contacts(contacts->second, walls, frame);
        sample.frames.push_back(std::move(frame));
      }
    if (!files.hdf5.empty())
      for (ForeignFrame &frame : read_lmgc90_hdf5(files.hdf5, bodies, densities))
        sample.frames.push_back(std::move(frame));
    for (const std::string &path : files.unused)
      sample.remarks.push_back(path + ": this file is not needed");
    std::sort(sample.frames.begin(), sample.frames.end(), [](const auto &a, const auto &b) { return *a.time < *b.time; });
    add_wall_tables(sample, files.wall_tables);
    return sample;
  }
} // namespace diptych::coupling
