// diptych: tests of displacement increments between meshes, and of strains on fields of known gradient
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/fields/node_transfer.h"
#include "coupling/fields/strain_increment.h"
#include "tests/coupling/synthetic_samples.h"

namespace
{
  using namespace diptych;
  using namespace diptych::coupling;

  using Field = std::function<Eigen::Vector2d(const Eigen::Vector2d &)>;

  // n x n nine-node cells of a quadrilateral with straight edges that are not parallel, moved by a displacement.
  continuum::Snapshot grid(const int n, const Field &displacement)
  {
    const Eigen::Vector2d corner[4] = {{0, 0}, {4, 0.5}, {3.5, 3}, {-0.5, 2.5}};
    const int             m         = 2 * n + 1;
    continuum::Snapshot   s;
    for (int j = 0; j < m; ++j)
      for (int i = 0; i < m; ++i)
        {
          const double          a = double(i) / (m - 1), b = double(j) / (m - 1);
          const Eigen::Vector2d x = (1 - a) * (1 - b) * corner[0] + a * (1 - b) * corner[1] + a * b * corner[2] +
                                    (1 - a) * b * corner[3];
          s.displacement.push_back(displacement(x));
          s.position.emplace_back(x + s.displacement.back());
          s.weight.push_back(1);
        }
    s.cells = synthetic::nine_node_cells(n, n);
    return s;
  }

  // The displacement is so large that a search at the deformed places would find other cells.
  Eigen::Vector2d affine(const Eigen::Vector2d &x)
  {
    return {0.7 + 0.3 * x.x() - 0.2 * x.y(), -0.4 + 0.1 * x.x() - 0.5 * x.y()};
  }

  TEST(NodeTransfer, ReproducesAnAffineFieldAtTheNodesOfAFinerMesh)
  {
    const auto from = grid(3, affine), to = grid(6, [](const Eigen::Vector2d &x) { return Eigen::Vector2d(2 * affine(x)); });
    const auto found = displacement_at_nodes_of(from, to);
    ASSERT_EQ(found.size(), to.position.size());
    for (std::size_t k = 0; k < found.size(); ++k)
      EXPECT_LT((found[k] - affine(to.position[k] - to.displacement[k])).norm(), 1e-12);
    const DisplacementField field = displacement_field(from, to); // 2 u - u
    for (std::size_t k = 0; k < found.size(); ++k)
      EXPECT_LT((field.increment[k] - found[k]).norm(), 1e-12);
  }

  // On cells of a unit square the quadratic x y is one of the biquadratic functions.
  TEST(NodeTransfer, DividedCellsKeepTheBiquadraticField)
  {
    const auto square = [](const int n) {
      continuum::Snapshot s = grid(n, [](const Eigen::Vector2d &) { return Eigen::Vector2d(0, 0); });
      const int           m = 2 * n + 1;
      for (int k = 0; k < m * m; ++k)
        {
          const double x = double(k % m) / (m - 1), y = double(k / m) / (m - 1);
          s.displacement[k] = {x * x * y * y - y, 3 * x * y * y};
          s.position[k]     = Eigen::Vector2d(x, y) + s.displacement[k];
        }
      return s;
    };
    const auto from = square(2), to = square(8), back = square(2);
    const auto found = displacement_at_nodes_of(from, to);
    for (std::size_t k = 0; k < found.size(); ++k)
      EXPECT_LT((found[k] - to.displacement[k]).norm(), 1e-12);
    EXPECT_EQ(displacement_at_nodes_of(from, back), from.displacement); // for the same mesh, its own nodes bit by bit
  }

  TEST(NodeTransfer, RejectsANodeOutsideTheEarlierMesh)
  {
    const auto from = grid(2, affine);
    auto       to   = grid(3, affine);
    to.position.back() += Eigen::Vector2d(1, 1);
    EXPECT_THROW(displacement_at_nodes_of(from, to), std::invalid_argument);
  }

  DisplacementField affine_field(const Eigen::Matrix2d &gradient, const Eigen::Vector2d &origin)
  {
    std::mt19937_64   random(1);
    DisplacementField field;
    for (int i = 0; i < 600; ++i)
      {
        const double          across = synthetic::uniform(random, 0, 20);
        const Eigen::Vector2d x      = origin + Eigen::Vector2d(across, synthetic::uniform(random, 0, 30));
        field.position.push_back(x);
        field.increment.push_back(Eigen::Vector2d(0.3, -0.2) + gradient * x);
        field.weight.push_back(synthetic::uniform(random, 0.3, 1.5));
      }
    return field;
  }

  TEST(StrainIncrement, AffineFieldIsReproduced)
  {
    Eigen::Matrix2d gradient;
    gradient << 0.02, 0.05, -0.01, -0.03;
    // eps_1 - eps_2 = sqrt((e_xx - e_yy)^2 + (2 e_xy)^2) = sqrt(0.05^2 + 0.04^2).
    const double shear = std::hypot(0.05, 0.04);
    for (const Eigen::Vector2d &origin : {Eigen::Vector2d(0, 0), Eigen::Vector2d(-50, 70)})
      {
        const auto field = affine_field(gradient, origin);
        for (const auto &g : displacement_gradient(field, field.position, strain_radius(1)))
          EXPECT_LT((g - gradient).norm(), 1e-12);
        for (const double s : shear_strain_increment(field, field.position, strain_radius(1)))
          EXPECT_NEAR(s, shear, 1e-12);
      }
  }

  TEST(StrainIncrement, RattlersOfNoWeightAreIgnored)
  {
    Eigen::Matrix2d gradient;
    gradient << 0.02, 0.05, -0.01, -0.03;
    auto field = affine_field(gradient, {0, 0});
    for (std::size_t i = 0; i < field.position.size(); i += 7)
      {
        field.increment[i] = {100, -50};
        field.weight[i]    = 0;
      }
    for (const double s : shear_strain_increment(field, field.position, strain_radius(1)))
      EXPECT_NEAR(s, std::hypot(0.05, 0.04), 1e-12);
  }

  TEST(StrainIncrement, TooFewPointsOrPointsOnALineGiveNaN)
  {
    DisplacementField field;
    field.position  = {{0, 0}, {1, 0}, {0, 1}, {10, 0}, {11, 0}, {12, 0}, {13, 0}, {14, 0}};
    field.increment = field.position;
    field.weight.assign(field.position.size(), 1.);
    const auto shear = shear_strain_increment(field, {{0.3, 0.3}, {12, 0}, {500, 500}}, 2.5);
    EXPECT_TRUE(std::isnan(shear[0])); // three points
    EXPECT_TRUE(std::isnan(shear[1])); // five on a line
    EXPECT_TRUE(std::isnan(shear[2])); // none
  }

  TEST(StrainIncrement, IncrementsBetweenSnapshotsUseTheLaterPositions)
  {
    diptych::discrete::Snapshot from, to;
    from.displacement = {{1, 0}, {0, 0}, {0, 0}};
    from.rattler      = {0, 0, 1};
    to.position       = {{5, 5}, {6, 5}, {7, 5}};
    to.displacement   = {{1.5, 0.25}, {0, 1}, {0, 0}};
    to.radius         = {0.5, 0.5, 0.5};
    to.rattler        = {0, 1, 0};
    const auto field  = displacement_field(from, to);
    EXPECT_EQ(field.position[0], Eigen::Vector2d(5, 5));
    EXPECT_EQ(field.increment[0], Eigen::Vector2d(0.5, 0.25));
    EXPECT_DOUBLE_EQ(field.weight[0], M_PI / 4);
    EXPECT_EQ(field.weight[1], 0);
    EXPECT_EQ(field.weight[2], 0);
    from.rattler        = {1, 1, 1}; // no grain has a contact yet
    const auto put_down = displacement_field(from, to);
    EXPECT_DOUBLE_EQ(put_down.weight[0], M_PI / 4);
    EXPECT_EQ(put_down.weight[1], 0);
    EXPECT_DOUBLE_EQ(put_down.weight[2], M_PI / 4);
    from.displacement.pop_back();
    EXPECT_THROW(displacement_field(from, to), std::invalid_argument);
  }
} // namespace
