// diptych: contact problems stored in the layout of FCLIB
// SPDX-License-Identifier: LGPL-2.1-or-later
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>

#include "discrete/contacts/natural_map.h"
#include "discrete/contacts/contact_law.h"
#include "discrete/problem_files/fclib.h"
#include "discrete/files/hdf5_file.h"

namespace
{
  using namespace diptych::discrete;

  std::string stored(const std::string &name)
  {
    return std::string(DIPTYCH_CONTACT_PROBLEMS) + "/" + name;
  }

  // A file of this test and this process, removed at the end.
  struct TemporaryFile
  {
    std::string path = std::filesystem::temp_directory_path() /
                       (std::string("diptych_") + testing::UnitTest::GetInstance()->current_test_info()->name() + ".h5");

    ~TemporaryFile() { std::remove(path.c_str()); }
  };

  // One matrix in the terms of FCLIB.
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

  // Two contacts; W_01 and W_10 differ in their tangential-normal entries, so that a transposed reading is found out:
  //       [ 2  0 | 0.5 0.2 ]
  //   W = [ 0  6 | 0.3 0.4 ]     q = (-1, 0.5, -2, 0), mu = (0.3, 0.5)
  //       [0.5 0.3 | 2   0 ]
  //       [0.2 0.4 | 0   6 ]
  const StoredMatrix by_rows = {
    4, 4, -2, {0, 3, 6, 9, 12}, {0, 2, 3, 1, 2, 3, 0, 1, 2, 0, 1, 3}, {2, .5, .2, 6, .3, .4, .5, .3, 2, .2, .4, 6}};
  const StoredMatrix by_columns = {
    4, 4, -1, {0, 3, 6, 9, 12}, {0, 2, 3, 1, 2, 3, 0, 1, 2, 0, 1, 3}, {2, .5, .2, 6, .3, .4, .5, .3, 2, .2, .4, 6}};

  // p: columns, i: rows; W_00 in two parts, which are added.
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

  // The message with which a file is refused; empty: it is read.
  std::string refusal(const std::string &path)
  {
    try
      {
        read_fclib(path);
      }
    catch (const std::invalid_argument &error)
      {
        return error.what();
      }
    return "";
  }

  void expect_refused(const LocalFile &content, const std::vector<std::string> &words)
  {
    const TemporaryFile file;
    content.write(file.path);
    const std::string message = refusal(file.path);
    EXPECT_NE(message, "") << "was read";
    for (const std::string &word : words)
      EXPECT_NE(message.find(word), std::string::npos) << "no '" << word << "' in: " << message;
    EXPECT_NE(message.find(file.path), std::string::npos) << message;
  }

  TEST(Fclib, EveryStorageOfAMatrixIsTheSameProblem)
  {
    const TemporaryFile file;
    LocalFile().write(file.path);
    const DelassusProblem reference = read_fclib_local(file.path);
    ASSERT_EQ(reference.n_contacts(), 2u);
    // u = W r + q of r = (1, 2 | 3, 4): rows of the matrix above times r.
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

  // p and i of a triplet file exchanged would transpose a matrix that is not symmetric.
  TEST(Fclib, TripletsHaveTheColumnInP)
  {
    const TemporaryFile file;
    LocalFile           content;
    content.w = {4, 4, 5, {0, 1, 2, 3, 2}, {0, 1, 2, 3, 0}, {1, 1, 1, 1, 0.5}};
    content.write(file.path);
    const std::vector<RelativeVelocity> u = relative_velocities(read_fclib_local(file.path), {{0, 0}, {1, 0}});
    EXPECT_EQ(u[0].normal, 0.5 - 1);
  }

  // One contact in two velocity coordinates: the diagonal mass matrix of the first is full in the second, W and q are the same.
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
    EXPECT_NE(refusal(file.path).find("positive definite"), std::string::npos);
  }

  TEST(Fclib, MalformedFilesAreRefusedByName)
  {
    for (const std::string name : {"spacedim", "W", "q", "mu"})
      {
        LocalFile content;
        content.without = name;
        expect_refused(content, {"/fclib_local/", name, "missing"});
      }
    const auto refused = [](const auto &change, const std::vector<std::string> &words) {
      LocalFile content;
      change(content);
      expect_refused(content, words);
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

  TEST(Fclib, FilesThatAreNoneAreRefused)
  {
    const TemporaryFile file;
    EXPECT_NE(refusal(file.path), "") << "missing";
    std::ofstream(file.path) << "no HDF5 file";
    EXPECT_NE(refusal(file.path), "");
    std::ifstream     whole(stored("small.h5"), std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(whole), {}};
    std::ofstream(file.path, std::ios::binary) << bytes.substr(0, bytes.size() / 2);
    EXPECT_NE(refusal(file.path).find(file.path), std::string::npos) << "truncated";
    Hdf5Writer empty(file.path);
    empty.finish();
    EXPECT_NE(refusal(file.path).find("neither"), std::string::npos);
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
    EXPECT_NE(refusal(file.path).find("/fclib_local/V"), std::string::npos);
  }

  // Coulomb and Signorini of u = W r + q, scaled by the largest impulse and the largest velocity.
  void expect_complementary(const DelassusProblem &problem, const std::vector<Impulse> &r, const double tolerance)
  {
    const std::vector<RelativeVelocity> u       = relative_velocities(problem, r);
    double                              largest = 0, fastest = 0;
    for (std::size_t k = 0; k < r.size(); ++k)
      largest = std::max(largest, r[k].normal), fastest = std::max(fastest, std::abs(problem.q[k].normal));
    for (std::size_t k = 0; k < r.size(); ++k)
      {
        EXPECT_GE(r[k].normal, 0);
        EXPECT_GE(u[k].normal, -tolerance * fastest);
        EXPECT_LT(std::min(r[k].normal / largest, u[k].normal / fastest), tolerance);
        EXPECT_LE(std::abs(r[k].tangential), problem.friction[k] * r[k].normal * (1 + 1e-12));
        // Where the impulse is off its bound on one side, nothing may slide against it.
        const double room = (problem.friction[k] * r[k].normal + r[k].tangential) / largest;
        EXPECT_LT(std::min(room, u[k].tangential / fastest), tolerance);
        const double other_room = (problem.friction[k] * r[k].normal - r[k].tangential) / largest;
        EXPECT_LT(std::min(other_room, -u[k].tangential / fastest), tolerance);
      }
  }

  SolverOptions options_for(const ContactSolver solver, const double tolerance)
  {
    SolverOptions options;
    options.solver     = solver;
    options.tolerance  = tolerance;
    options.max_sweeps = 1000000;
    return options;
  }

  std::vector<Impulse> solved(const StoredProblem &problem,
                              const std::string   &form,
                              const ContactSolver  solver,
                              const double         tolerance)
  {
    const SolverOptions  options = options_for(solver, tolerance);
    std::vector<Impulse> r(problem.local.n_contacts());
    const SolveReport    report = form == "body" ? solve(*problem.bodies, options, r) : solve(problem.local, options, r);
    EXPECT_EQ(report.status, SolveStatus::converged) << name_of(solver) << ", " << form << ", residual " << report.residual;
    EXPECT_LE(natural_map_residual(problem.local, r), 1.01 * tolerance) << name_of(solver) << ", " << form;
    std::cout << problem.local.n_contacts() << " contacts, " << name_of(solver) << ", " << form << ", " << tolerance << ": "
              << report.sweeps << " sweeps, " << report.cpu_s << " s, "
              << 1e9 * report.cpu_s / double(report.sweeps * long(r.size())) << " ns an update\n";
    return r;
  }

  // The contacts' own blocks couple normal and tangential directions (W_nt = 0.8, W_nn = 2, W_tt = 3): still complementary.
  TEST(Fclib, AContactWithCoupledDirectionsIsSolved)
  {
    const TemporaryFile file;
    for (const double q_t : {-2., 0., 0.1, 2.})
      for (const double friction : {0., 0.3, 1.})
        {
          LocalFile content;
          content.w = {
            4, 4, -2, {0, 3, 6, 9, 12}, {0, 1, 2, 0, 1, 3, 0, 2, 3, 1, 2, 3}, {2, .8, .5, .8, 3, .4, .5, 2, -.8, .4, -.8, 3}};
          content.q        = {-1, q_t, -0.5, 0.2};
          content.friction = {friction, friction};
          content.write(file.path);
          const StoredProblem problem = read_fclib(file.path);
          for (const ContactSolver solver : {ContactSolver::nsgs, ContactSolver::psor})
            expect_complementary(problem.local, solved(problem, "local", solver, 1e-13), 1e-11);
        }
  }

  // Both descriptions of one file and its bodies are the same W and q; measured 2e-16.
  TEST(Fclib, LocalGlobalAndBodiesOfAStoredFileAgree)
  {
    for (const std::string name : {"small.h5", "medium.h5"})
      {
        const StoredProblem problem = read_fclib(stored(name));
        ASSERT_EQ(problem.form, "body") << problem.reason;
        EXPECT_LT(relative_difference(problem.local, read_fclib_global(stored(name))), 1e-13);
        EXPECT_LT(relative_difference(problem.local, delassus_form(*problem.bodies)), 1e-10);
        std::cout << name << ": global " << relative_difference(problem.local, read_fclib_global(stored(name))) << ", bodies "
                  << relative_difference(problem.local, delassus_form(*problem.bodies)) << "\n";
        // The same impulses, whatever they are, have the same residual in both forms.
        std::vector<Impulse> r;
        for (std::size_t k = 0; k < problem.local.n_contacts(); ++k)
          r.push_back({0.01 * double(k % 17), 0.002 * double(k % 5)});
        const double residual = natural_map_residual(problem.local, r);
        EXPECT_NEAR(natural_map_residual(*problem.bodies, r), residual, 1e-10 * residual);
      }
  }

  // The stored solution is Siconos' at 1e-8 of its own scale. Several exact solutions may exist: it is judged, not compared.
  TEST(Fclib, TheStoredSolutionIsOne)
  {
    for (const std::string name : {"small.h5", "medium.h5"})
      {
        const StoredProblem problem = read_fclib(stored(name));
        ASSERT_EQ(problem.solution.size(), problem.local.n_contacts());
        const Hdf5Reader reader(stored(name));
        const double     theirs = siconos_residual(problem.local, problem.solution);
        std::cout << name << ": natural map " << natural_map_residual(problem.local, problem.solution) << ", Siconos' scale "
                  << theirs << ", stored " << reader.attribute("/solution", "siconos_rel_natural_map_error") << "\n";
        EXPECT_LT(theirs, 1e-8);
        EXPECT_LT(natural_map_residual(problem.local, problem.solution), 1e-6);
      }
  }

  TEST(Fclib, EverySolverSolvesTheSmallProblemInBothForms)
  {
    const StoredProblem problem = read_fclib(stored("small.h5"));
    for (const ContactSolver solver : {ContactSolver::nsgs, ContactSolver::psor})
      for (const std::string form : {"body", "local"})
        expect_complementary(problem.local, solved(problem, form, solver, 1e-8), 1e-6);
  }

  TEST(Fclib, PsorSolvesTheMediumProblemInBothForms)
  {
    const StoredProblem problem = read_fclib(stored("medium.h5"));
    for (const std::string form : {"body", "local"})
      expect_complementary(problem.local, solved(problem, form, ContactSolver::psor, 1e-8), 1e-6);
  }

  // What is written again, with and without the geometry that the bodies need, is the same problem to the last bits, and is
  // solved to the same impulses.
  TEST(Fclib, AWrittenProblemIsReadBack)
  {
    const TemporaryFile        file;
    const StoredProblem        problem = read_fclib(stored("small.h5"));
    const std::vector<Impulse> r       = solved(problem, "body", ContactSolver::nsgs, 1e-8);
    const Hdf5Reader           reader(stored("small.h5"));
    const StoredGeometry       geometry = {reader.read("/nscd/dt")[0], reader.read("/nscd/gap"), reader.read("/nscd/radius"),
                                           reader.read_vectors("/nscd/x")};
    write_fclib(file.path, *problem.bodies, {"a title", "a description"}, geometry, r);
    const StoredProblem again = read_fclib(file.path);
    ASSERT_EQ(again.form, "body") << again.reason;
    EXPECT_LT(relative_difference(problem.local, again.local), 1e-13);
    EXPECT_LT(relative_difference(problem.local, read_fclib_global(file.path)), 1e-13);
    EXPECT_EQ(Hdf5Reader(file.path).read_string("/fclib_local/info/title"), "a title");
    EXPECT_EQ(again.bodies->order, problem.bodies->order);
    const std::vector<Impulse> r_again = solved(again, "body", ContactSolver::nsgs, 1e-8);
    for (std::size_t k = 0; k < r.size(); ++k)
      {
        EXPECT_EQ(again.solution[k].normal, r[k].normal);
        EXPECT_NEAR(r_again[k].normal, r[k].normal, 1e-6);
        EXPECT_NEAR(r_again[k].tangential, r[k].tangential, 1e-6);
      }
    write_fclib(file.path, *problem.bodies, {"a title", "a description"});
    const StoredProblem without = read_fclib(file.path);
    EXPECT_EQ(without.form, "local");
    EXPECT_NE(without.reason, "");
    EXPECT_LT(relative_difference(problem.local, without.local), 1e-13);
    EXPECT_FALSE(std::filesystem::exists(file.path + ".part"));
  }

  // Two discs across the edge of a free cell: its width is a body, and both forms agree on u and on the residual.
  TEST(Fclib, AFreeCellCouplesTheContactsAcrossItsEdge)
  {
    ContactProblem problem;
    problem.free_velocity = {{0.1, -1, 0.2, 1}, {-0.3, 0, 0, 0.5}, {-0.2, 0, 0, 0.25}}; // disc, disc, cell
    const double c = 0.6, s = 0.8;
    problem.contacts                 = {{c, s, 0, 1, 1, 2, 2, 1, 0.5, 0.5, 0.1, 0, 0.4, 1 / 1.5, 1 / 4.5},
                                        {1, 0, 0, 1, 0, -1, 2, 1, 0.5, 0.5, 0, 0.2, 0.4, 1 / 1.5, 1 / 4.5}};
    const DelassusProblem      local = delassus_form(problem);
    const std::vector<Impulse> r     = {{0.7, 0.1}, {0.2, -0.05}};
    // v = v_free + M^-1 H r by hand is what velocities() does; u + c must be the same.
    const std::vector<BodyVelocity>     v = velocities(problem, r);
    const std::vector<RelativeVelocity> u = relative_velocities(local, r);
    for (int k = 0; k < 2; ++k)
      {
        const RelativeVelocity direct = relative_velocity(problem.contacts[k], v);
        EXPECT_NEAR(u[k].normal, direct.normal + problem.contacts[k].normal_term, 1e-14);
        EXPECT_NEAR(u[k].tangential, direct.tangential + problem.contacts[k].tangential_term, 1e-14);
      }
    // W_nn of the first: 1/m_i + 1/m_j + (image n_x)^2 / m_cell.
    EXPECT_NEAR(local.blocks[0].nn, 1.5 + c * c * 0.25, 1e-15);
    EXPECT_NEAR(local.blocks[0].nt, -c * s * 0.25, 1e-15);
    const TemporaryFile file;
    write_fclib(file.path, problem, {"two discs", "across the edge of a free cell"},
                StoredGeometry{0.1, {0, 0}, {1, 1}, {{0, 0}, {1, 1}}});
    const StoredProblem again = read_fclib(file.path);
    EXPECT_EQ(again.form, "local");
    EXPECT_LT(relative_difference(local, again.local), 1e-15);
    EXPECT_LT(relative_difference(local, read_fclib_global(file.path)), 1e-14);
  }

  // A grain with two different translational inertias is none: the file is still solved, in the local form, and says why.
  TEST(Fclib, BodiesThatAreNoDiscsFallBackToTheLocalForm)
  {
    const TemporaryFile file;
    {
      const Hdf5Reader reader(stored("small.h5"));
      Hdf5Writer       writer(file.path);
      writer.copy(reader, "fclib_local");
      for (const std::string &name : reader.members("/nscd"))
        if (name != "Minv_diag" && name != "H")
          {
            if (name == "body_i" || name == "body_j")
              writer.write("/nscd/" + name, reader.read_int("/nscd/" + name));
            else
              writer.write("/nscd/" + name, reader.read("/nscd/" + name));
          }
      std::vector<double> inverse_mass = reader.read("/nscd/Minv_diag");
      inverse_mass[3] *= 1.1;
      writer.write("/nscd/Minv_diag", inverse_mass);
      writer.finish();
    }
    const StoredProblem problem = read_fclib(file.path);
    EXPECT_EQ(problem.form, "local");
    EXPECT_FALSE(problem.bodies);
    EXPECT_NE(problem.reason.find("disc 1"), std::string::npos) << problem.reason;
    EXPECT_EQ(problem.local.n_contacts(), 214u);
  }

  TEST(Fclib, ASolutionIsWrittenBesideItsProblem)
  {
    const TemporaryFile        file;
    const StoredProblem        problem = read_fclib(stored("small.h5"));
    const std::vector<Impulse> r       = solved(problem, "body", ContactSolver::psor, 1e-8);
    write_solution(stored("small.h5"), file.path,
                   {r, relative_velocities(problem.local, r), "psor", "converged", natural_map_residual(problem.local, r)});
    const StoredProblem again = read_fclib(file.path);
    EXPECT_EQ(again.form, "body");
    EXPECT_EQ(relative_difference(problem.local, again.local), 0);
    for (std::size_t k = 0; k < r.size(); ++k)
      EXPECT_EQ(again.solution[k].tangential, r[k].tangential);
    EXPECT_LE(Hdf5Reader(file.path).attribute("/solution", "residual"), 1.01e-8);
    write_solution(file.path, file.path, {r, relative_velocities(problem.local, r), "psor", "converged", 0});
    EXPECT_EQ(Hdf5Reader(file.path).attribute("/solution", "residual"), 0);
  }
} // namespace
