// diptych: files written by other codes, and changed copies of them
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <filesystem>
#include <fstream>
#include <functional>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <unistd.h>

#include "coupling/import/arrival.h"
#include "coupling/import/readers.h"
#include "coupling/scene/scene_error.h"

namespace diptych::coupling::foreign_files
{
  inline std::string path_of(const std::string &name)
  {
    return std::string(DIPTYCH_SOURCE_DIR) + "/tests/foreign/" + name;
  }

  struct Case
  {
    std::string                                          name, truth;
    std::function<ForeignSample(const ForeignOptions &)> read;
    std::vector<std::string>                             files; // below tests/foreign
    bool                                                 spheres = false;
    double                                               stress_tolerance; // relative to the largest component
  };

  inline std::vector<std::string> numbered(const std::vector<std::string> &names, const std::vector<std::string> &numbers)
  {
    std::vector<std::string> files;
    for (const std::string &name : names)
      for (const std::string &number : numbers)
        {
          std::string file = name;
          files.push_back(file.replace(file.find('*'), 1, number));
        }
    return files;
  }

  // Stresses agree to the digits of the files: nine or more, seven in LMGC90's text. truth.json was computed from the same
  // files.
  inline std::vector<Case> cases()
  {
    const std::vector<std::string> steps = {"50000", "100000", "150000", "200000"}, four = {"0", "1", "2", "3"};
    return {
      {"lammps",
       "lammps",
       read_lammps,
       {"lammps/grains.dump", "lammps/contacts.dump", "lammps/walls.dump", "lammps/walls.txt"},
       false,
       1e-6},
      {"liggghts", "liggghts", read_liggghts,
       numbered({"liggghts/grains_*.dump", "liggghts/contacts_*.dump", "liggghts/wallcontacts_*.dump", "liggghts/plates_*.stl"},
                steps),
       true, 1e-5},
      {"yade", "yade", read_yade, numbered({"yade/spheres_*.txt", "yade/contacts_*.txt", "yade/walls_*.txt"}, four), true, 1e-6},
      {"lmgc90",
       "lmgc90",
       read_lmgc90,
       {"lmgc90/DATBOX/BODIES.DAT", "lmgc90/DATBOX/BULK_BEHAV.DAT", "lmgc90/OUTBOX/DOF.OUT.1", "lmgc90/OUTBOX/DOF.OUT.3",
        "lmgc90/OUTBOX/Vloc_Rloc.OUT.1", "lmgc90/OUTBOX/Vloc_Rloc.OUT.3"},
       false,
       1e-6},
      {"lmgc90_hdf5",
       "lmgc90_hdf5",
       read_lmgc90,
       {"lmgc90/DATBOX/BODIES.DAT", "lmgc90/DATBOX/BULK_BEHAV.DAT", "lmgc90_hdf5/lmgc90.h5"},
       false,
       1e-6},
      {"mercurydpm",
       "mercurydpm",
       read_mercurydpm,
       {"mercurydpm/Biaxial2D.data", "mercurydpm/Biaxial2D.fstat", "mercurydpm/Biaxial2D.ene", "mercurydpm/Biaxial2D.restart.4"},
       false,
       1e-6},
      {"csv", "plain_csv", read_plain_csv, numbered({"plain_csv/particles_*.csv", "plain_csv/contacts_*.csv"}, {"0", "1", "2"}),
       false, 1e-4}};
  }

  inline ForeignOptions options_of(const Case &c)
  {
    ForeignOptions options;
    for (const std::string &file : c.files)
      options.files.push_back(path_of(file));
    if (c.name == "csv")
      options.files.push_back(path_of("plain_csv/walls.csv"));
    if (c.spheres)
      options.thickness = 1;
    return options;
  }

  inline Case case_of(const std::string &name)
  {
    for (const Case &c : cases())
      if (c.name == name)
        return c;
    throw std::logic_error("no case " + name);
  }

  inline Arrival arrival_of(const Case &c, const ForeignOptions &options)
  {
    return arrive(c.read(options), options);
  }

  inline std::string text_of_file(const std::string &path)
  {
    std::ifstream      in(path, std::ios::binary);
    std::ostringstream out;
    out << in.rdbuf();
    return out.str();
  }

  // A temporary folder.
  class Scratch
  {
  public:
    Scratch()
        : folder(std::filesystem::path(testing::TempDir()) /
                 ("import" + std::to_string(::getpid()) + "_" + std::to_string(count++)))
    {
      std::filesystem::create_directories(folder);
    }
    ~Scratch() { std::filesystem::remove_all(folder); }

    std::string write(const std::string &name, const std::string &text) const
    {
      std::filesystem::create_directories((folder / name).parent_path());
      std::ofstream(folder / name, std::ios::binary) << text;
      return (folder / name).string();
    }

    std::filesystem::path folder;

  private:
    static inline int count = 0;
  };

  // The files of a case with one of them changed.
  inline ForeignOptions with_changed(const Case                               &c,
                                     const Scratch                            &scratch,
                                     const std::string                        &name,
                                     const std::function<void(std::string &)> &change)
  {
    ForeignOptions options = options_of(c);
    for (std::string &file : options.files)
      if (file == path_of(name))
        {
          std::string text = text_of_file(file);
          change(text);
          file = scratch.write(std::filesystem::path(file).filename().string(), text);
          return options;
        }
    throw std::logic_error("no file " + name);
  }

  inline void replace_once(std::string &text, const std::string &from, const std::string &to)
  {
    const std::size_t at = text.find(from);
    if (at == std::string::npos)
      throw std::logic_error("'" + from + "' is not there");
    text.replace(at, from.size(), to);
  }

  // The message of the refusal; empty if there is none.
  inline std::string refusal_of(const Case &c, const ForeignOptions &options)
  {
    try
      {
        (void)arrival_of(c, options);
      }
    catch (const std::invalid_argument &error)
      {
        return error.what();
      }
    return "";
  }

  inline bool holds(const std::vector<std::string> &texts, const std::string &word)
  {
    for (const std::string &text : texts)
      if (text.find(word) != std::string::npos)
        return true;
    return false;
  }
} // namespace diptych::coupling::foreign_files
