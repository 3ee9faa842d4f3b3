// diptych: averaging by a conservative L2 projection onto linear elements with a smoothing length
// SPDX-License-Identifier: LGPL-2.1-or-later
#include <cmath>
#include <numeric>
#include <stdexcept>

#include <Eigen/SparseCholesky>

#include "coupling/averaging/averaging_methods.h"
#include "coupling/averaging/linear_elements.h"

namespace diptych::coupling
{
  namespace
  {
    class NodalLoads
    {
    public:
      NodalLoads(const TargetCells &target, const Unknowns &unknowns, const Eigen::Index n_columns)
          : load(Columns::Zero(unknowns.n, n_columns)),
            target(target),
            unknowns(unknowns)
      {}

      template <class Row>
      void add(const unsigned int     triangle,
               const Eigen::Vector2d &x,
               const double           share,
               const Row             &row,
               const Eigen::Index     first)
      {
        const Eigen::Vector3d shape = shape_values(target, triangle, x);
        const CellTriangle   &nodes = target.mesh.triangle[triangle % target.mesh.triangle.size()];
        for (int a = 0; a < 3; ++a)
          load.row(unknowns.of_node[nodes.node[a]]).segment(first, row.size()) += share * shape[a] * row;
      }

      Columns load;

    private:
      const TargetCells &target;
      const Unknowns    &unknowns;
    };

    using Solver = Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>>;

    // The share of grain i in cell K is sum_a N_a(x_i) y_a. Here (M + l^2 K) y = integrals of N_a over the cell. The sum of the
    // shares over grains is sum_a n_a y_a and that of their squares y . B y. Here n_a = sum_i N_a(x_i) and B_ab = sum_i
    // N_a(x_i) N_b(x_i).
    std::vector<double> joined_by_projection(const TargetCells &target,
                                             const Carriers    &carriers,
                                             const Unknowns    &unknowns,
                                             const Solver      &solver)
    {
      std::vector<Eigen::Triplet<double>> entries;
      Eigen::VectorXd                     n = Eigen::VectorXd::Zero(unknowns.n);
      for (const Eigen::Vector2d &x : carriers.position)
        {
          const unsigned int    triangle = target.search.locate(x).triangle;
          const Eigen::Vector3d shape    = shape_values(target, triangle, x);
          const auto           &node     = target.mesh.triangle[triangle % target.mesh.triangle.size()].node;
          for (int a = 0; a < 3; ++a)
            {
              n[unknowns.of_node[node[a]]] += shape[a];
              for (int b = 0; b < 3; ++b)
                entries.emplace_back(unknowns.of_node[node[a]], unknowns.of_node[node[b]], shape[a] * shape[b]);
            }
        }
      Eigen::SparseMatrix<double> squares(unknowns.n, unknowns.n);
      squares.setFromTriplets(entries.begin(), entries.end());

      std::vector<double> joined;
      for (unsigned int t = 0; joined.size() < target.n_cells();)
        {
          Eigen::VectorXd integral = Eigen::VectorXd::Zero(unknowns.n);
          for (const unsigned int cell = joined.size(); t < target.mesh.triangle.size() && target.mesh.triangle[t].cell == cell;
               ++t)
            for (const unsigned int node : target.mesh.triangle[t].node)
              integral[unknowns.of_node[node]] += triangle_area(target.mesh, t) / 3;
          const Eigen::VectorXd y   = solver.solve(integral);
          const double          sum = n.dot(y), sum_of_squares = y.dot(squares * y);
          joined.push_back(sum_of_squares > 0 ? sum * sum / sum_of_squares : 0);
        }
      return joined;
    }

    // N_a is linear in a piece. The midpoint rule is therefore exact for a uniform density, and Simpson's rule for a tapered one.
    double add_halves(const TargetCells &target, const Carriers &carriers, const Eigen::Index first, NodalLoads &loads)
    {
      const Eigen::Index                 n_uniform = carriers.uniform.cols(), n_tapered = carriers.tapered.cols();
      std::vector<TriangleSearch::Piece> pieces;
      double                             outside = 0;
      for (std::size_t h = 0; h < carriers.half.size(); ++h)
        {
          const Eigen::Vector2d &start = carriers.position[carriers.half[h].grain], &vector = carriers.half[h].vector;
          target.search.cut(start, start + vector, pieces);
          for (const TriangleSearch::Piece &p : pieces)
            {
              const double length = p.to - p.from, middle = 0.5 * (p.from + p.to);
              if (n_uniform > 0)
                loads.add(p.triangle, start + middle * vector, length, carriers.uniform.row(Eigen::Index(h)), first);
              if (n_tapered > 0)
                for (const auto &[t, weight] : {std::pair(p.from, 1. / 6), std::pair(middle, 4. / 6), std::pair(p.to, 1. / 6)})
                  loads.add(p.triangle, start + t * vector, 2 * (1 - t) * weight * length, carriers.tapered.row(Eigen::Index(h)),
                            first + n_uniform);
              outside += p.inside ? 0 : length * carriers.half_size[h];
            }
        }
      const double size = std::accumulate(carriers.half_size.begin(), carriers.half_size.end(), 0.);
      return size > 0 ? outside / size : 0;
    }
  } // namespace

  CellSums average_by_projection(const TargetCells &target, const Carriers &carriers, const double width)
  {
    // 1 / (1 + l^2 k^2) = 1 - w^2 k^2 / 2 + ... has the variance w^2 along each axis.
    const double       length   = width / std::sqrt(2.);
    const Unknowns     unknowns = number_unknowns(target);
    const Eigen::Index n_grain = carriers.of_grains.cols(), n_uniform = carriers.uniform.cols(),
                       n_tapered = carriers.tapered.cols();
    NodalLoads loads(target, unknowns, n_grain + n_uniform + n_tapered);
    if (n_grain > 0)
      for (std::size_t i = 0; i < carriers.position.size(); ++i)
        loads.add(target.search.locate(carriers.position[i]).triangle, carriers.position[i], 1,
                  carriers.of_grains.row(Eigen::Index(i)), 0);
    CellSums sums      = zero_sums(target, carriers);
    sums.outside_share = add_halves(target, carriers, n_grain, loads);

    const Solver solver(helmholtz_matrix(target.mesh, unknowns, length));
    if (solver.info() != Eigen::Success)
      throw std::runtime_error("averaging = projection: the smoothing matrix could not be factorised");
    if (carriers.count_joined)
      sums.joined = joined_by_projection(target, carriers, unknowns, solver);
    const Columns density = solver.solve(Eigen::MatrixXd(loads.load)); // at the nodes [quantity / length^2]
    for (unsigned int t = 0; t < target.mesh.triangle.size(); ++t)
      for (const unsigned int node : target.mesh.triangle[t].node)
        {
          const double       third = triangle_area(target.mesh, t) / 3;
          const unsigned int cell = target.mesh.triangle[t].cell, a = unknowns.of_node[node];
          sums.of_grains.row(cell) += third * density.row(a).head(n_grain);
          sums.uniform.row(cell) += third * density.row(a).segment(n_grain, n_uniform);
          sums.tapered.row(cell) += third * density.row(a).tail(n_tapered);
        }
    return sums;
  }
} // namespace diptych::coupling
