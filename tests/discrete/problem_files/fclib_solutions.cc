// diptych: solutions of stored contact problems, in every form
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "tests/discrete/problem_files/fclib_examples.h"

namespace
{
  // Coulomb and Signorini for u = W r + q, scaled by the largest impulse and the largest velocity.
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
        // If the impulse is off its bound on one side, nothing may slide against it.
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
                              const ProblemForm    form,
                              const ContactSolver  solver,
                              const double         tolerance)
  {
    const SolverOptions  options = options_for(solver, tolerance);
    std::vector<Impulse> r(problem.local.n_contacts());
    const SolveReport report = form == ProblemForm::body ? solve(*problem.bodies, options, r) : solve(problem.local, options, r);
    EXPECT_EQ(report.status, SolveStatus::converged)
      << name_of(solver) << ", " << name_of(form) << ", residual " << report.residual;
    EXPECT_LE(natural_map_residual(problem.local, r), 1.01 * tolerance) << name_of(solver) << ", " << name_of(form);
    return r;
  }

  // The contacts' own blocks couple normal and tangential directions (W_nt = 0.8, W_nn = 2, W_tt = 3). The solution is still
  // complementary.
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
            expect_complementary(problem.local, solved(problem, ProblemForm::local, solver, 1e-13), 1e-11);
        }
  }

  StoredProblem local_problem(const Eigen::Matrix4d &w, const Eigen::Vector4d &q)
  {
    StoredProblem problem;
    problem.local = delassus_problem(Eigen::SparseMatrix<double, Eigen::RowMajor>(w.sparseView()), q, Eigen::Vector2d(0.5, 0.5));
    return problem;
  }

  // A disc of mass m rests on a disc of mass 1, and this on a plane, both after a step of free fall with velocity 1: the contacts
  // carry m + 1 and m. Sweeps need some multiple of m. A residual relative to |r| alone ends them when 3 % of the weight are
  // carried. Velocity errors of 100 tolerances at both contacts change the impulses by 3e-3 at most.
  TEST(Fclib, AHeavyDiscOnALightOneIsCarriedOrNotSolved)
  {
    ThreadTeam team(1);
    for (const double mass : {1e3, 1e4, 1e6})
      for (const ContactSolver solver : {ContactSolver::nsgs, ContactSolver::psor})
        {
          Eigen::Matrix4d w;
          w << 1, 0, -1, 0, 0, 3, 0, 1, -1, 0, 1 + 1 / mass, 0, 0, 1, 0, 3 + 3 / mass;
          SolverOptions options        = options_for(solver, 2e-5);
          options.max_sweeps           = 50000;
          std::vector<Impulse> r       = {{}, {}};
          const StoredProblem  problem = local_problem(w, {-1, 0, 0, 0});
          const SolveReport    report  = problem.solve(ProblemForm::local, options, r, team);
          EXPECT_EQ(report.status, mass > 1e5   ? SolveStatus::max_sweeps_reached
                                   : mass > 1e3 ? report.status
                                                : SolveStatus::converged);
          if (report.status == SolveStatus::converged)
            {
              EXPECT_NEAR(r[0].normal, mass + 1, 3e-3 * mass) << name_of(solver);
              EXPECT_NEAR(r[1].normal, mass, 3e-3 * mass) << name_of(solver);
            }
        }
  }

  // A rod that slides on its end: W_nn < mu |W_nt|, so a relaxation of one part at a time diverges. Slipping in the direction of
  // -u_t, r_n = 0.1 / (W_nn - mu W_nt) would be negative; in the other one r_n = 0.1 / (W_nn + mu W_nt).
  TEST(Fclib, AContactWhoseFrictionPressesTheBodiesTogetherIsSolved)
  {
    Eigen::MatrixXd w(2, 2);
    w << 1.35093334, 0.96418141, 0.96418141, 3.64906666;
    const DelassusProblem problem = delassus_problem(Eigen::SparseMatrix<double, Eigen::RowMajor>(w.sparseView()),
                                                     Eigen::Vector2d(-0.1, -1), Eigen::VectorXd::Constant(1, 3.));
    for (const ContactSolver solver : {ContactSolver::nsgs, ContactSolver::psor})
      {
        std::vector<Impulse> r(1);
        EXPECT_EQ(solve(problem, options_for(solver, 1e-8), r).status, SolveStatus::converged) << name_of(solver);
        EXPECT_NEAR(r[0].normal, 0.1 / (w(0, 0) + 3 * w(0, 1)), 1e-12);
        EXPECT_NEAR(r[0].tangential, 3 * r[0].normal, 1e-12);
      }
  }

  // Both descriptions of a file and its bodies give the same W and q; measured 2e-16.
  TEST(Fclib, LocalGlobalAndBodiesOfAStoredFileAgree)
  {
    for (const std::string name : {"small.h5", "medium.h5"})
      {
        const StoredProblem problem = read_fclib(stored(name));
        ASSERT_EQ(problem.form, ProblemForm::body) << problem.reason;
        EXPECT_LT(relative_difference(problem.local, read_fclib_global(stored(name))), 1e-13);
        EXPECT_LT(relative_difference(problem.local, delassus_form(*problem.bodies)), 1e-10);
        // Any impulses have the same residual in both forms.
        std::vector<Impulse> r;
        for (std::size_t k = 0; k < problem.local.n_contacts(); ++k)
          r.push_back({0.01 * double(k % 17), 0.002 * double(k % 5)});
        const double residual = natural_map_residual(problem.local, r);
        EXPECT_NEAR(natural_map_residual(*problem.bodies, r), residual, 1e-10 * residual);
      }
  }

  // The stored solution is that of Siconos at 1e-8 of its scale. Several exact solutions may exist, so the test checks it by the
  // laws.
  TEST(Fclib, TheStoredSolutionSolvesTheProblem)
  {
    for (const std::string name : {"small.h5", "medium.h5"})
      {
        const StoredProblem problem = read_fclib(stored(name));
        ASSERT_EQ(problem.solution.size(), problem.local.n_contacts());
        EXPECT_LT(siconos_residual(problem.local, problem.solution), 1e-8);
        EXPECT_LT(natural_map_residual(problem.local, problem.solution), 1e-6);
      }
  }

  TEST(Fclib, EverySolverSolvesTheSmallProblemInBothForms)
  {
    const StoredProblem problem = read_fclib(stored("small.h5"));
    for (const ContactSolver solver : {ContactSolver::nsgs, ContactSolver::psor})
      for (const ProblemForm form : {ProblemForm::body, ProblemForm::local})
        expect_complementary(problem.local, solved(problem, form, solver, 1e-8), 1e-6);
  }

  TEST(Fclib, PsorSolvesTheMediumProblemInBothForms)
  {
    const StoredProblem problem = read_fclib(stored("medium.h5"));
    for (const ProblemForm form : {ProblemForm::body, ProblemForm::local})
      expect_complementary(problem.local, solved(problem, form, ContactSolver::psor, 1e-8), 1e-6);
  }

  // A problem written again, with and without the geometry of the bodies, is the same to the last bits and has the same solution.
  TEST(Fclib, AWrittenProblemIsReadBack)
  {
    const TemporaryFile        file;
    const StoredProblem        problem = read_fclib(stored("small.h5"));
    const std::vector<Impulse> r       = solved(problem, ProblemForm::body, ContactSolver::nsgs, 1e-8);
    const Hdf5Reader           reader(stored("small.h5"));
    const StoredGeometry       geometry = {reader.read("/nscd/dt")[0], reader.read("/nscd/gap"), reader.read("/nscd/radius"),
                                           reader.read_vectors("/nscd/x")};
    write_fclib(file.path, *problem.bodies, {"a title", "a description"}, geometry, r);
    const StoredProblem again = read_fclib(file.path);
    ASSERT_EQ(again.form, ProblemForm::body) << again.reason;
    EXPECT_LT(relative_difference(problem.local, again.local), 1e-13);
    EXPECT_LT(relative_difference(problem.local, read_fclib_global(file.path)), 1e-13);
    EXPECT_EQ(Hdf5Reader(file.path).read_string("/fclib_local/info/title"), "a title");
    EXPECT_EQ(again.bodies->order, problem.bodies->order);
    const std::vector<Impulse> r_again = solved(again, ProblemForm::body, ContactSolver::nsgs, 1e-8);
    for (std::size_t k = 0; k < r.size(); ++k)
      {
        EXPECT_EQ(again.solution[k].normal, r[k].normal);
        EXPECT_NEAR(r_again[k].normal, r[k].normal, 1e-6);
        EXPECT_NEAR(r_again[k].tangential, r[k].tangential, 1e-6);
      }
    write_fclib(file.path, *problem.bodies, {"a title", "a description"});
    const StoredProblem without = read_fclib(file.path);
    EXPECT_EQ(without.form, ProblemForm::local);
    EXPECT_NE(without.reason, "");
    EXPECT_LT(relative_difference(problem.local, without.local), 1e-13);
    EXPECT_FALSE(std::filesystem::exists(file.path + ".part"));
  }

  // Without rolling resistance a file does not mention it.
  TEST(Fclib, RollingResistanceIsReadBackWithTheBodiesAndOnlyWithThem)
  {
    const TemporaryFile  file;
    const Hdf5Reader     reader(stored("small.h5"));
    const StoredGeometry geometry = {reader.read("/nscd/dt")[0], reader.read("/nscd/gap"), reader.read("/nscd/radius"),
                                     reader.read_vectors("/nscd/x")};
    ContactProblem       bodies   = *read_fclib(stored("small.h5")).bodies;
    write_fclib(file.path, bodies, {}, geometry);
    EXPECT_FALSE(Hdf5Reader(file.path).has("/rolling"));
    for (ContactRow &c : bodies.contacts)
      set_rolling(0.1, 0.4, c);
    std::vector<Impulse> r(bodies.contacts.size());
    SolverOptions        options;
    EXPECT_EQ(solve(bodies, options, r).status, SolveStatus::converged);
    write_fclib(file.path, bodies, {}, geometry, r);
    const StoredProblem again = read_fclib(file.path);
    EXPECT_LT(natural_map_residual(*again.bodies, again.solution), 2 * options.tolerance);
    EXPECT_GT(std::abs(again.solution[0].rolling), 0);
    EXPECT_NE(again.obstacle(ProblemForm::local), "");
    write_fclib(file.path, bodies, {});
    expect_refused({file.path, "/rolling"}, [&] { read_fclib(file.path); });
  }

  // Two discs across the edge of a free cell. The width is a body, and both forms agree on u and on the residual.
  TEST(Fclib, AFreeCellCouplesTheContactsAcrossItsEdge)
  {
    ContactProblem problem;
    problem.free_velocity = {{0.1, -1, 0.2, 1}, {-0.3, 0, 0, 0.5}, {-0.2, 0, 0, 0.25}}; // disc, disc, cell
    const double c = 0.6, s = 0.8;
    problem.contacts                 = {{c, s, 0, 1, 1, 2, 2, 1, 0.5, 0.5, 0.1, 0, 0.4, 1 / 1.5, 1 / 4.5},
                                        {1, 0, 0, 1, 0, -1, 2, 1, 0.5, 0.5, 0, 0.2, 0.4, 1 / 1.5, 1 / 4.5}};
    const DelassusProblem      local = delassus_form(problem);
    const std::vector<Impulse> r     = {{0.7, 0.1}, {0.2, -0.05}};
    // v = v_free + M^-1 H r is computed by velocities(). u + c must be the same.
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
    EXPECT_EQ(again.form, ProblemForm::local);
    EXPECT_LT(relative_difference(local, again.local), 1e-15);
    EXPECT_LT(relative_difference(local, read_fclib_global(file.path)), 1e-14);
  }

  // A grain with two different inverse masses is not a disc. The file is still solved, in the local form, and the reason is
  // given.
  TEST(Fclib, BodiesThatAreNotDiscsFallBackToTheLocalForm)
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
    EXPECT_EQ(problem.form, ProblemForm::local);
    EXPECT_FALSE(problem.bodies);
    EXPECT_NE(problem.reason.find("disc 1"), std::string::npos) << problem.reason;
    EXPECT_EQ(problem.local.n_contacts(), 214u);
  }

  TEST(Fclib, ASolutionIsWrittenBesideItsProblem)
  {
    const TemporaryFile        file;
    const StoredProblem        problem = read_fclib(stored("small.h5"));
    const std::vector<Impulse> r       = solved(problem, ProblemForm::body, ContactSolver::psor, 1e-8);
    write_solution(stored("small.h5"), file.path,
                   {r, relative_velocities(problem.local, r), "psor", "converged", natural_map_residual(problem.local, r)});
    const StoredProblem again = read_fclib(file.path);
    EXPECT_EQ(again.form, ProblemForm::body);
    EXPECT_EQ(relative_difference(problem.local, again.local), 0);
    for (std::size_t k = 0; k < r.size(); ++k)
      EXPECT_EQ(again.solution[k].tangential, r[k].tangential);
    EXPECT_LE(Hdf5Reader(file.path).attribute("/solution", "residual"), 1.01e-8);
    write_solution(file.path, file.path, {r, relative_velocities(problem.local, r), "psor", "converged", 0});
    EXPECT_EQ(Hdf5Reader(file.path).attribute("/solution", "residual"), 0);
  }
} // namespace
