// diptych: contact problems stored in the layout of FCLIB
// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hdf5.h>

#include "tests/discrete/problem_files/fclib_examples.h"

namespace
{
  TEST(Fclib, EveryStorageOfAMatrixIsTheSameProblem)
  {
    const TemporaryFile file;
    LocalFile().write(file.path);
    const DelassusProblem reference = read_fclib_local(file.path);
    ASSERT_EQ(reference.n_contacts(), 2u);
    // u = W r + q for r = (1, 2 | 3, 4): rows of the matrix above times r.
    const std::vector<RelativeVelocity> u = relative_velocities(reference, {{1, 2}, {3, 4}});
    EXPECT_NEAR(u[0].normal, 2 + 1.5 + 0.8 - 1, 1e-15);
    EXPECT_NEAR(u[0].tangential, 12 + 0.9 + 1.6 + 0.5, 1e-14);
    EXPECT_NEAR(u[1].normal, 0.5 + 0.6 + 6 - 2, 1e-15);
    EXPECT_NEAR(u[1].tangential, 0.2 + 0.8 + 24, 1e-14);
    for (const StoredMatrix &w : {by_columns, triplets})
      {
        LocalFile content;
        content.w = w;
        content.write(file.path);
        EXPECT_EQ(relative_difference(reference, read_fclib_local(file.path)), 0) << "nz " << w.nz;
      }
  }

  // If p and i of a triplet file were swapped, a matrix that is not symmetric would be transposed.
  TEST(Fclib, TripletsHaveTheColumnInP)
  {
    const TemporaryFile file;
    LocalFile           content;
    content.w = {4, 4, 5, {0, 1, 2, 3, 2}, {0, 1, 2, 3, 0}, {1, 1, 1, 1, 0.5}};
    content.write(file.path);
    const std::vector<RelativeVelocity> u = relative_velocities(read_fclib_local(file.path), {{0, 0}, {1, 0}});
    EXPECT_EQ(u[0].normal, 0.5 - 1);
  }

  // One contact in two velocity coordinates. The mass matrix is diagonal in the first and full in the second; W and q are the
  // same.
  TEST(Fclib, AMassMatrixThatIsNotDiagonalIsFactorised)
  {
    const TemporaryFile file;
    const auto          write = [&](const StoredMatrix &m, const StoredMatrix &h, const std::vector<double> &f) {
      Hdf5Writer writer(file.path);
      writer.write("/fclib_global/spacedim", std::vector<int>{2});
      write_matrix(writer, "/fclib_global/M", m), write_matrix(writer, "/fclib_global/H", h);
      writer.write("/fclib_global/vectors/f", f);
      writer.write("/fclib_global/vectors/w", std::vector<double>{0.1, 0});
      writer.write("/fclib_global/vectors/mu", std::vector<double>{0.3});
      writer.finish();
    };
    // v = (v_n, v_t): M = diag(2, 4), H = I, f = (-2, 4). In a = (v_n, v_t - v_n): v = T a with T = [1 0; 1 1], so
    // T^T M T = [6 4; 4 4], T^T H = [1 1; 0 1], T^T f = (2, 4).
    write({2, 2, -2, {0, 1, 2}, {0, 1}, {2, 4}}, {2, 2, -2, {0, 1, 2}, {0, 1}, {1, 1}}, {-2, 4});
    const DelassusProblem diagonal = read_fclib_global(file.path);
    EXPECT_NEAR(diagonal.blocks[0].nn, 0.5, 1e-15);
    EXPECT_NEAR(diagonal.q[0].normal, -1 + 0.1, 1e-15);
    write({2, 2, -2, {0, 2, 4}, {0, 1, 0, 1}, {6, 4, 4, 4}}, {2, 2, -2, {0, 2, 3}, {0, 1, 1}, {1, 1, 1}}, {2, 4});
    EXPECT_LT(relative_difference(diagonal, read_fclib_global(file.path)), 1e-14);
    write({2, 2, -2, {0, 2, 4}, {0, 1, 0, 1}, {1, 4, 4, 1}}, {2, 2, -2, {0, 2, 3}, {0, 1, 1}, {1, 1, 1}}, {2, 4});
    expect_unread(file.path, {"positive definite"});
  }

  TEST(Fclib, MalformedFilesAreRefusedByName)
  {
    for (const std::string name : {"spacedim", "W", "q", "mu"})
      {
        LocalFile content;
        content.without = name;
        expect_unread(content, {"/fclib_local/", name, "missing"});
      }
    const auto refused = [](const auto &change, const std::vector<std::string> &words) {
      LocalFile content;
      change(content);
      expect_unread(content, words);
    };
    refused([](LocalFile &f) { f.spacedim = 3; }, {"/fclib_local/spacedim", "3"});
    refused([](LocalFile &f) { f.q.pop_back(); }, {"/fclib_local/vectors/q", "3", "4"});
    refused([](LocalFile &f) { f.q[1] = NAN; }, {"/fclib_local/vectors/q", "nan"});
    refused([](LocalFile &f) { f.friction = {0.3, -0.1}; }, {"/fclib_local/vectors/mu", "-0.1"});
    refused([](LocalFile &f) { f.friction = {0.3}; }, {"/fclib_local/W", "4 x 4", "2 x 2"});
    refused([](LocalFile &f) { f.w.i[2] = 4; }, {"/fclib_local/W", "(0, 4)"});
    refused([](LocalFile &f) { f.w.i[2] = -1; }, {"/fclib_local/W", "(0, -1)"});
    refused([](LocalFile &f) { f.w.p.pop_back(); }, {"/fclib_local/W/p", "4", "5"});
    refused([](LocalFile &f) { f.w.p[1] = 7; }, {"/fclib_local/W/p", "decrease"});
    refused([](LocalFile &f) { f.w.i.pop_back(); }, {"/fclib_local/W/i", "11", "12"});
    refused([](LocalFile &f) { f.w.x.pop_back(); }, {"/fclib_local/W/x", "11", "12"});
    refused([](LocalFile &f) { f.w.nz = -3; }, {"/fclib_local/W/nz", "-3"});
    refused([](LocalFile &f) { f.w.nz = 20; }, {"/fclib_local/W/p", "20"});
    refused([](LocalFile &f) { f.w.m = -4; }, {"/fclib_local/W", "-4"});
    refused([](LocalFile &f) { f.w.x[0] = 0; }, {"/fclib_local/W", "diagonal entry 0", "positive"});
    refused([](LocalFile &f) { f.w.x[3] = -6; }, {"/fclib_local/W", "diagonal entry 1", "-6"});
  }

  // The local form is solved, but the global form and the gaps are copied to the file of the solution.
  TEST(Fclib, NumbersThatTheSolverDoesNotUseAreAlsoChecked)
  {
    for (const std::string name : {"/fclib_global/M/x", "/fclib_global/vectors/f", "/nscd/H/x", "/nscd/gap"})
      {
        const TemporaryFile file;
        std::filesystem::copy_file(stored("small.h5"), file.path, std::filesystem::copy_options::overwrite_existing);
        ASSERT_TRUE(Hdf5Reader(file.path).has("/fclib_local"));
        const hid_t         handle = H5Fopen(file.path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
        std::vector<double> values = Hdf5Reader(stored("small.h5")).read(name);
        values[2]                  = INFINITY;
        const hid_t array          = H5Dopen2(handle, name.c_str(), H5P_DEFAULT);
        ASSERT_GE(H5Dwrite(array, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), 0);
        H5Dclose(array), H5Fclose(handle);
        expect_unread(file.path, {name});
      }
  }

  TEST(Fclib, OtherFilesAreRefused)
  {
    const TemporaryFile file;
    expect_unread(file.path, {}); // missing
    write_text(file.path, "no HDF5 file");
    expect_unread(file.path, {});
    const std::string bytes = read_text(stored("small.h5"));
    write_text(file.path, bytes.substr(0, bytes.size() / 2));
    expect_unread(file.path, {});
    Hdf5Writer(file.path).finish();
    expect_unread(file.path, {"neither"});
  }

  TEST(Fclib, EqualityConstraintsAreRefused)
  {
    const TemporaryFile file;
    Hdf5Writer          writer(file.path);
    writer.write("/fclib_local/spacedim", std::vector<int>{2});
    write_matrix(writer, "/fclib_local/W", by_rows);
    write_matrix(writer, "/fclib_local/V", {4, 1, -2, {0, 1, 1, 1, 1}, {0}, {1.}});
    writer.write("/fclib_local/vectors/q", std::vector<double>(4, 0.));
    writer.write("/fclib_local/vectors/mu", std::vector<double>(2, 0.));
    writer.finish();
    expect_unread(file.path, {"/fclib_local/V"});
  }
} // namespace
