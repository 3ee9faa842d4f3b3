// diptych: event-driven hard discs, beside contact dynamics and springs
// SPDX-License-Identifier: LGPL-2.1-or-later
//
// event_driven WIDTH HEIGHT PLATENS E_N E_T FRICTION END COLLISIONS ROWS < GRAINS: discs fly straight between collisions, which
// take no time and involve two bodies. A line of GRAINS is x y r vx vy omega; the density is 1. WIDTH and HEIGHT are periods;
// with PLATENS 1 two platens at y = 0 and HEIGHT replace the second one. E_N, E_T and FRICTION are those of every collision. The
// run stops at the time END (inf: none), at this number of collisions or at a collapse. It prints JSON: a summary, the history
// (time, kinetic energy, collisions; ROWS intervals up to END) and the grains. The same input gives the same bits.
#include <algorithm>
#include <cmath>
#include <complex>
#include <cstdio>
#include <ctime>
#include <iostream>
#include <limits>
#include <queue>
#include <stdexcept>
#include <string>
#include <tuple>
#include <vector>

namespace
{
  constexpr double never = std::numeric_limits<double>::infinity();

  using Vector = std::complex<double>; // x + i y

  struct Disc
  {
    Vector   x, v;
    double   omega, r, mass;
    double   time      = 0; // of x
    unsigned collision = 0; // number of them so far
    int      cell[2]   = {0, 0};
    double   burst     = -never; // start of collisions in quick succession
    int      in_burst  = 0;      // their number
  };

  // Partners below 0: a side of the cell that the disc crosses (left, right, bottom, top), or a platen.
  constexpr int to_left = -1, to_top = -4, lower_platen = -5, upper_platen = -6;

  struct Event
  {
    double   time;
    int      i, j;
    unsigned collision_i, collision_j; // if the discs have collided since, the event does not happen

    // The earliest event is on top of the queue; ties go by number.
    bool operator<(const Event &other) const { return std::tie(time, i, j) > std::tie(other.time, other.i, other.j); }
  };

  struct Gas
  {
    double            size[2]; // periods
    bool              platens; // at the ends of the second one
    double            e_n, e_t, friction;
    std::vector<Disc> disc       = {};
    double            time       = 0;
    long              collisions = 0;
    bool              collapsed  = false;

    double                        side[2]  = {0, 0}; // of a cell
    int                           cells[2] = {0, 0};
    std::vector<std::vector<int>> members  = {}; // of each cell
    std::priority_queue<Event>    queue    = {};

    void start()
    {
      double largest = 0;
      for (const Disc &d : disc)
        largest = std::max(largest, 2 * d.r);
      for (const int axis : {0, 1})
        {
          cells[axis] = int(size[axis] / largest);
          side[axis]  = size[axis] / cells[axis];
          if (cells[axis] < 3)
            throw std::invalid_argument("width and height must be at least three times the largest diameter");
        }
      members.resize(std::size_t(cells[0]) * cells[1]);
      for (std::size_t i = 0; i < disc.size(); ++i)
        {
          for (const int axis : {0, 1})
            {
              double &x = coordinate(disc[i], axis);
              x -= size[axis] * std::floor(x / size[axis]);
              disc[i].cell[axis] = std::min(int(x / side[axis]), cells[axis] - 1);
            }
          members_of(disc[i].cell[0], disc[i].cell[1]).push_back(int(i));
        }
      for (std::size_t i = 0; i < disc.size(); ++i)
        predict(int(i), -1);
    }

    double next() const { return queue.empty() ? never : queue.top().time; }

    // Handles the next event.
    void step()
    {
      const Event event = queue.top();
      queue.pop();
      if (event.collision_i != disc[event.i].collision || (event.j >= 0 && event.collision_j != disc[event.j].collision))
        return;
      time = event.time;
      if (event.j < 0 && event.j >= to_top)
        return cross(event.i, to_left - event.j);
      collide(event.i, event.j);
      predict(event.i, -1);
      if (event.j >= 0)
        predict(event.j, event.i);
    }

    double kinetic_energy() const
    {
      double energy = 0;
      for (const Disc &d : disc)
        energy += 0.5 * d.mass * (std::norm(d.v) + 0.5 * d.r * d.r * d.omega * d.omega);
      return energy;
    }

    Vector position(const Disc &d) const { return d.x + (time - d.time) * d.v; }

    static double &coordinate(Disc &d, const int axis) { return reinterpret_cast<double(&)[2]>(d.x)[axis]; }

    std::vector<int> &members_of(const int column, const int row) { return members[std::size_t(row) * cells[0] + column]; }

    // From the centre of the nearest image of b to that of a.
    Vector branch(const Disc &a, const Disc &b) const
    {
      const Vector l = position(a) - position(b);
      return l - Vector(size[0] * std::round(l.real() / size[0]), platens ? 0. : size[1] * std::round(l.imag() / size[1]));
    }

    void push(const double after, const int i, const int j)
    {
      queue.push({time + std::max(0., after), i, j, disc[i].collision, j >= 0 ? disc[j].collision : 0u});
    }

    // Meetings of disc i with the members of a cell around its own. Discs that approach and overlap by round-off collide at once.
    void predict_cell(const int i, const int across, const int upward, const int except)
    {
      const int column = (disc[i].cell[0] + across + cells[0]) % cells[0], above = disc[i].cell[1] + upward;
      if (platens && (above < 0 || above >= cells[1]))
        return;
      for (const int j : members_of(column, (above + cells[1]) % cells[1]))
        {
          const Vector l = branch(disc[i], disc[j]), w = disc[i].v - disc[j].v;
          const double b = (std::conj(l) * w).real(), sum = disc[i].r + disc[j].r, c = std::norm(l) - sum * sum;
          if (const double root = b * b - std::norm(w) * c; j != i && j != except && b < 0 && root >= 0)
            push(c / (std::sqrt(root) - b), i, j);
        }
    }

    // All events of disc i, but those with the disc `except`.
    void predict(const int i, const int except)
    {
      for (const int upward : {-1, 0, 1})
        for (const int across : {-1, 0, 1})
          predict_cell(i, across, upward, except);
      const double y = position(disc[i]).imag(), v = disc[i].v.imag();
      if (platens && v != 0)
        push(((v < 0 ? disc[i].r : size[1] - disc[i].r) - y) / v, i, v < 0 ? lower_platen : upper_platen);
      predict_crossing(i);
    }

    // A disc meets a platen before it would cross the edge of the cell there.
    void predict_crossing(const int i)
    {
      const Disc  &d    = disc[i];
      const Vector at   = position(d);
      const double x[2] = {at.real(), at.imag()}, v[2] = {d.v.real(), d.v.imag()};
      double       after[2];
      for (const int axis : {0, 1})
        after[axis] = v[axis] == 0 ? never : ((d.cell[axis] + (v[axis] > 0)) * side[axis] - x[axis]) / v[axis];
      const int first = after[1] < after[0];
      if (after[first] < never)
        push(after[first], i, to_left - 2 * first - (v[first] > 0));
    }

    // Disc i enters the cell on the given side of its own (0: left, 1: right, 2: bottom, 3: top).
    void cross(const int i, const int to)
    {
      Disc     &d    = disc[i];
      const int axis = to / 2, sign = to % 2 ? 1 : -1;
      d.x        = position(d);
      d.time     = time;
      auto &left = members_of(d.cell[0], d.cell[1]);
      left.erase(std::find(left.begin(), left.end(), i));
      d.cell[axis]        = (d.cell[axis] + sign + cells[axis]) % cells[axis];
      coordinate(d, axis) = (d.cell[axis] + (sign < 0)) * side[axis]; // on the edge, without round-off
      members_of(d.cell[0], d.cell[1]).push_back(i);
      for (const int along : {-1, 0, 1})
        predict_cell(i, axis == 0 ? sign : along, axis == 0 ? along : sign, -1);
      predict_crossing(i);
    }

    // Walton's law. Vectors are turned into normal + i x tangential; the tangent is the normal turned to the left. A disc has the
    // moment of inertia m r^2/2, so the tangent has three times the inverse mass 1/m_i + 1/m_j of the normal.
    void collide(const int i, const int j)
    {
      const Disc   still = {0, 0, 0, 0, never};
      const Disc  &a = disc[i], &b = j >= 0 ? disc[j] : still;
      const Vector l = j >= 0 ? branch(a, b) : Vector(0, j == lower_platen ? 1 : -1), normal = l / std::abs(l);
      const Vector u    = (a.v - b.v) * std::conj(normal) - Vector(0, a.omega * a.r + b.omega * b.r);
      const double mass = 1 / (1 / a.mass + 1 / b.mass), pressed = -(1 + e_n) * u.real() * mass;
      const double rubbed = std::clamp(-(1 + e_t) * u.imag() * mass / 3, -friction * pressed, friction * pressed);
      ++collisions;
      hit(disc[i], Vector(pressed, rubbed) * normal, rubbed);
      if (j >= 0)
        hit(disc[j], -Vector(pressed, rubbed) * normal, rubbed);
    }

    // Inelastic collapse: a disc collides 20 times within 1e-9 of the mean time between two collisions of a disc so far.
    void hit(Disc &d, const Vector &given, const double tangential)
    {
      d.x    = position(d);
      d.time = time;
      d.v += given / d.mass;
      d.omega -= 2 * tangential / (d.mass * d.r);
      ++d.collision;
      if (time - d.burst > 1e-9 * time * double(disc.size()) / double(2 * collisions))
        {
          d.burst    = time;
          d.in_burst = 0;
        }
      collapsed |= ++d.in_burst == 20;
    }
  };

  void run(Gas gas, const double end, const double most, const double rows)
  {
    gas.start();
    int                row   = 0;
    const std::clock_t start = std::clock();
    std::printf("{\"history\": [");
    while (double(gas.collisions) < most && gas.time < end && !gas.collapsed)
      {
        for (; row <= rows && row * end / rows <= std::min(gas.next(), end); ++row)
          std::printf("%s[%f, %f, %ld]", row ? ", " : "", row * end / rows, gas.kinetic_energy(), gas.collisions);
        if (gas.next() > end || gas.next() == never)
          gas.time = end;
        else
          gas.step();
      }
    std::printf("],\n\"time\": %.17g, \"energy\": %.17g, \"collisions\": %ld, \"collapsed\": %s, \"seconds\": %g,\n\"grains\": [",
                gas.time, gas.kinetic_energy(), gas.collisions, gas.collapsed ? "true" : "false",
                double(std::clock() - start) / CLOCKS_PER_SEC);
    for (const Disc &d : gas.disc)
      std::printf("%s\n[%.17g, %.17g, %.17g, %.17g, %.17g, %.17g]", &d == &gas.disc[0] ? "" : ",", gas.position(d).real(),
                  gas.position(d).imag(), d.r, d.v.real(), d.v.imag(), d.omega);
    std::puts("]}");
  }
} // namespace

int main(const int argc, char **argv)
{
  try
    {
      std::vector<double> o;
      for (int k = 1; k < argc; ++k)
        o.push_back(std::stod(argv[k]));
      if (o.size() != 9)
        throw std::invalid_argument("give nine numbers, as the head of event_driven.cc says");
      Gas gas{{o[0], o[1]}, o[2] != 0, o[3], o[4], o[5]};
      for (double x, y, r, vx, vy, omega; std::cin >> x >> y >> r >> vx >> vy >> omega;)
        gas.disc.push_back({{x, y}, {vx, vy}, omega, r, M_PI * r * r});
      run(std::move(gas), o[6], o[7], o[8]);
    }
  catch (const std::exception &error)
    {
      std::fprintf(stderr, "event_driven: %s\n", error.what());
      return 2;
    }
}
