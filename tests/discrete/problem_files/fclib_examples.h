// diptych: problem files for tests
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "discrete/contacts/natural_map.h"
#include "discrete/contacts/contact_law.h"
#include "discrete/problem_files/fclib.h"
#include "discrete/files/hdf5_file.h"
#include "discrete/files/text_file.h"
#include "tests/common.h"

namespace
{
  using namespace diptych::discrete;
  using namespace diptych::tests;

  std::string stored(const std::string &name)
  {
    return std::string(DIPTYCH_CONTACT_PROBLEMS) + "/" + name;
  }

  struct TemporaryFile
  {
    const Folder      folder;
    const std::string path = folder / "problem.h5";
  };

  // One matrix in the notation of FCLIB.
  struct StoredMatrix
  {
    int                 m, n, nz;
    std::vector<int>    p, i;
    std::vector<double> x;
  };

  void write_matrix(Hdf5Writer &writer, const std::string &name, const StoredMatrix &matrix)
  {
    writer.write(name + "/m", std::vector<int>{matrix.m});
    writer.write(name + "/n", std::vector<int>{matrix.n});
    writer.write(name + "/nz", std::vector<int>{matrix.nz});
    writer.write(name + "/nzmax", std::vector<int>{int(matrix.x.size())});
    writer.write(name + "/p", matrix.p), writer.write(name + "/i", matrix.i), writer.write(name + "/x", matrix.x);
  }

  // Two contacts. W_01 and W_10 differ in their tangential-normal entries, so that the test notices a transposed matrix:
  //       [ 2  0 | 0.5 0.2 ]
  //   W = [ 0  6 | 0.3 0.4 ]     q = (-1, 0.5, -2, 0), mu = (0.3, 0.5)
  //       [0.5 0.3 | 2   0 ]
  //       [0.2 0.4 | 0   6 ]
  const StoredMatrix by_rows = {
    4, 4, -2, {0, 3, 6, 9, 12}, {0, 2, 3, 1, 2, 3, 0, 1, 2, 0, 1, 3}, {2, .5, .2, 6, .3, .4, .5, .3, 2, .2, .4, 6}};
  const StoredMatrix by_columns = {4, 4, -1, by_rows.p, by_rows.i, by_rows.x}; // W is symmetric

  // p: columns, i: rows. W_00 is in two parts, which are added.
  const StoredMatrix triplets = {4,
                                 4,
                                 13,
                                 {0, 0, 2, 3, 1, 2, 3, 0, 1, 2, 0, 1, 3},
                                 {0, 0, 0, 0, 1, 1, 1, 2, 2, 2, 3, 3, 3},
                                 {1.5, .5, .5, .2, 6, .3, .4, .5, .3, 2, .2, .4, 6}};

  struct LocalFile
  {
    StoredMatrix        w = by_rows;
    std::vector<double> q = {-1, 0.5, -2, 0}, friction = {0.3, 0.5};
    int                 spacedim = 2;
    std::string         without; // dataset that is left out

    void write(const std::string &path) const
    {
      Hdf5Writer writer(path);
      if (without != "spacedim")
        writer.write("/fclib_local/spacedim", std::vector<int>{spacedim});
      if (without != "W")
        write_matrix(writer, "/fclib_local/W", w);
      if (without != "q")
        writer.write("/fclib_local/vectors/q", q);
      if (without != "mu")
        writer.write("/fclib_local/vectors/mu", friction);
      writer.finish();
    }
  };

  inline void expect_unread(const std::string &path, std::vector<std::string> words)
  {
    words.push_back(path);
    expect_refused(words, [&] { read_fclib(path); });
  }

  inline void expect_unread(const LocalFile &content, const std::vector<std::string> &words)
  {
    const TemporaryFile file;
    content.write(file.path);
    expect_unread(file.path, words);
  }
} // namespace
