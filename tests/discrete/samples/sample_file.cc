// diptych: grains from files read back exactly, or are refused with their place
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "discrete/samples/placed_grains.h"
#include "tests/discrete/samples/sample_file_examples.h"

namespace
{
  // --- grains from CSV

  TEST(GrainsFromCsv, ColumnsMayHaveAnyOrderAndMissingOnesAreZero)
  {
    const GrainFile file = read("# two discs\nr,y,x,fixed\n0.5, 1, 2, 1\n\n0.25,4,-3,0\n");
    const Grains   &g    = file.grains;
    ASSERT_EQ(g.size(), 2u);
    EXPECT_EQ(g.position[0], Eigen::Vector2d(2, 1));
    EXPECT_EQ(g.position[1], Eigen::Vector2d(-3, 4));
    EXPECT_EQ(g.velocity[1], Eigen::Vector2d(0, 0));
    EXPECT_EQ(g.spin[1], 0);
    EXPECT_EQ(g.rotation[1], 0);
    // rho pi r^2 with rho = 2
    EXPECT_DOUBLE_EQ(g.mass[0], 2 * M_PI * 0.25);
    EXPECT_EQ(file.line, (std::vector<int>{3, 5}));
    EXPECT_EQ(file.place(1), csv + ", line 5");
  }

  TEST(GrainsFromCsv, FixedGrainsHaveNoInverseMass)
  {
    const Grains g = read("x,y,r,vx,vy,omega,fixed\n0,0,1,0.1,0.2,0.3,1\n3,0,1,0,0,0,0\n").grains;
    EXPECT_EQ(g.inverse_mass(0), 0);
    EXPECT_DOUBLE_EQ(g.inverse_mass(1), 1 / (2 * M_PI));
    EXPECT_EQ(g.velocity[0], Eigen::Vector2d(0.1, 0.2));
    EXPECT_EQ(g.spin[0], 0.3);
  }

  TEST(GrainsFromCsv, WrittenGrainsReadBackWithTheSameBits)
  {
    Grains written;
    for (int k = 0; k < 100; ++k)
      {
        add_grain(written, {std::sin(k) / 3, 1e5 * std::cos(k)}, 0.5 + std::sin(k * k) / M_PI, 1.7);
        written.velocity.back() = {-1. / (k + 1), 1e-9 * std::exp(k / 10.)};
        written.spin.back()     = std::sqrt(k) - 5;
        written.fixed.back()    = k % 7 == 0;
      }
    write_grains_csv(csv, written);
    const GrainFile file = read_grains_csv(csv, 1.7);
    EXPECT_EQ(file.grains.position, written.position);
    EXPECT_EQ(file.grains.velocity, written.velocity);
    EXPECT_EQ(file.grains.spin, written.spin);
    EXPECT_EQ(file.grains.radius, written.radius);
    EXPECT_EQ(file.grains.mass, written.mass);
    EXPECT_EQ(file.grains.fixed, written.fixed);
    EXPECT_EQ(file.line.front(), 2); // below the header
    EXPECT_EQ(file.line.back(), 101);
    EXPECT_FALSE(std::filesystem::exists(csv + ".part"));
    EXPECT_THROW(write_grains_csv("/nowhere/at/all.csv", written), std::runtime_error);
  }

  // An exception of the hook is no fault of the file, which would be a std::invalid_argument.
  TEST(GrainsFromCsv, AReadingThatIsStoppedIsLeftAtOnce)
  {
    SampleOptions options;
    options.file = csv;
    write_text(csv, "x,y,r\n0,0,1\n5,0,1\n");
    EXPECT_THROW(check_sample_file(options, {}, [] { throw std::runtime_error("stopped"); }), std::runtime_error);
    EXPECT_FALSE(file_sample(options, {}, [] { return false; }));
    EXPECT_EQ(file_sample(options, {}, [] { return true; })->state.grains.size(), 2u);
  }

  // Faults of any table are those of csv_file.cc.
  TEST(GrainsFromCsv, EveryValueOutOfRangeIsNamed)
  {
    for (const auto &[rows, fault] :
         {std::pair{"x,y,r\n0,0,0\n", "'r' = '0' is out of range; allowed: more than 0: 1e-12 to 1e12"},
          {"x,y,r\n0,0,-2\n", "'r' = '-2' is out of range; allowed: more than 0: 1e-12 to 1e12"},
          {"x,y,r\n0,1e13,1\n", "'y' = '1e+13' is out of range; allowed: -1e12 to 1e12"},
          {"x,y,r,vx\n0,0,1,-1e13\n", "'vx' = '-1e+13' is out of range; allowed: -1e12 to 1e12"},
          {"x,y,r,fixed\n0,0,1,0.5\n",
           "'fixed' = '0.5' is out of range; allowed: 0 (free), 1 (held), 2 or 3 (part of the lower or upper platen)"}})
      expect_refused({csv + ", line 2: column " + fault}, [&] { read(rows); });
    expect_refused({"line 1: unknown column 'omga'; the nearest is 'omega'"}, [] { read("x,y,r,omga\n0,0,1,0\n"); });
  }

  // --- overlaps and walls

  std::string check(const std::string &rows, const SampleBox &box, const double allowed_overlap)
  {
    const GrainFile file = read("x,y,r,fixed\n" + rows);
    return complaint(csv, [&] { check_grains(file, box, allowed_overlap); });
  }

  // Radii 1 and 0.5 at a distance of 1.25 overlap by 0.25: half of the smaller radius.
  TEST(GrainCheck, OverlapIsMeasuredByTheSmallerRadius)
  {
    const std::string rows = "0,0,1,0\n9,9,1,0\n1.25,0,0.5,0\n";
    EXPECT_EQ(check(rows, {}, 0.5), "");
    EXPECT_EQ(check(rows, {}, 0.375),
              ", line 2 and line 4: the grains overlap by 0.5 of the smaller radius, at the distance 1.25 with radii that add to "
              "1.5; allowed: an overlap of 0 to 0.375 (1 such pair)");
  }

  TEST(GrainCheck, TheWorstOfSeveralOverlapsIsNamed)
  {
    // Unit discs at 0, 1.75 and 3.25: overlaps 0.25 and 0.5.
    EXPECT_EQ(check("0,0,1,0\n1.75,0,1,0\n3.25,0,1,0\n", {}, 0.),
              ", line 3 and line 4: the grains overlap by 0.5 of the smaller radius, at the distance 1.5 with radii that add to "
              "2; allowed: an overlap of 0 to 0 (2 such pairs; this is the worst)");
  }

  // Held or not, the number of pairs would be the square of the number of grains.
  TEST(GrainCheck, ACrowdInOnePlaceIsRefusedBeforeItsPairsAreSearched)
  {
    std::string rows;
    for (int i = 0; i < 100000; ++i)
      rows += "5,5,0.5,0\n";
    expect_words(check(rows, {}, 1),
                 {"line 2 and line 3: 100000 grains of similar size lie in one square with sides of length 1"});
  }

  TEST(GrainCheck, TouchingGrainsAndWallsAreNoOverlap)
  {
    EXPECT_EQ(check("1,1,1,0\n3,1,1,0\n", {0., 2., 0., 4.}, 0.), "");
  }

  // A disc of radius 1 may reach 0.125 beyond each side if the allowed overlap is 0.125.
  TEST(GrainCheck, GrainsBeyondEachSideAreNamedWithTheirReach)
  {
    const SampleBox box = {0., 10., -5., 5.};
    EXPECT_EQ(check("0,0.875,1,0\n", box, 0.125), "");
    EXPECT_EQ(check("0,5,1,0\n0,0.75,1,0\n", box, 0.125),
              ", line 3: y = 0.75 with r = 1 reaches to -0.25, beyond the lower platen at y = 0; allowed: -0.125 or more");
    EXPECT_EQ(check("0,9.25,1,0\n", box, 0.125),
              ", line 2: y = 9.25 with r = 1 reaches to 10.25, beyond the upper platen at y = 10; allowed: 10.125 or less");
    EXPECT_EQ(check("-4.5,5,1,0\n", box, 0.125),
              ", line 2: x = -4.5 with r = 1 reaches to -5.5, beyond the left wall at x = -5; allowed: -5.125 or more");
    EXPECT_EQ(check("7,5,1,0\n", box, 0.125),
              ", line 2: x = 7 with r = 1 reaches to 8, beyond the right wall at x = 5; allowed: 5.125 or less");
    EXPECT_EQ(check("7,5,1,0\n", {0., 10.}, 0.125), ""); // no side walls
  }

  // A rough bottom: discs on the lower platen, each of them over half of its neighbour.
  TEST(GrainCheck, FixedGrainsMayOverlapEachOtherAndStraddleThePlaten)
  {
    const std::string bottom = "0,0,1,1\n1,0,1,1\n";
    EXPECT_EQ(check(bottom, {0., 10.}, 0.), "");
    EXPECT_EQ(check(bottom + "0,-1.5,1,1\n", {0., 10.}, 0.),
              ", line 4: y = -1.5 with r = 1 reaches to -2.5, beyond the lower platen at y = 0; allowed: -2 or more");
    // A free grain among them is still an error: it reaches down to 0.5 above the platen, but 0.5 into the first disc.
    EXPECT_EQ(check(bottom + "0,1.5,1,0\n", {0., 10.}, 0.).find(", line 2 and line 4: the grains overlap by 0.5 of"), 0u);
  }

  // Unit discs at 0.5 and 19.75 in a period of 20 meet across its edge, 0.75 apart. They overlap by 1.25.
  TEST(GrainCheck, GrainsOverlapAcrossTheEdgeOfACell)
  {
    const std::string rows = "0.5,0,1,0\n19.75,0,1,0\n";
    EXPECT_EQ(check(rows, {}, 0.), "");
    SampleBox cell;
    cell.cell_width = 20;
    EXPECT_EQ(check(rows, cell, 0.).find(", line 2 and line 3: the grains overlap by 1.25 of"), 0u);
  }

  TEST(GrainCheck, GrainsOfASnapshotFileAreNamedByTheirNumber)
  {
    GrainFile file{"some.h5", {}};
    add_grain(file.grains, {0, 0}, 1, 1);
    add_grain(file.grains, {1, 0}, 1, 1);
    EXPECT_EQ(complaint("some.h5", [&] { check_grains(file, {}, 0.01); }).find(", grain 0 (counted from 0) and grain 1: the"),
              0u);
  }
} // namespace
