// diptych: samples from tables and snapshots of others
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "discrete/samples/placed_grains.h"
#include "discrete/files/hdf5_file.h"
#include "discrete/panel/snapshot_file.h"
#include "discrete/samples/sample_file.h"
#include "discrete/files/text_file.h"
#include "tests/common.h"

namespace
{
  using namespace diptych::discrete;
  using namespace diptych::tests;

  const Folder      samples;
  const std::string csv = samples / "grains.csv", h5 = samples / "grains.h5";

  GrainFile read(const std::string &text)
  {
    write_text(csv, text);
    return read_grains_csv(csv, 2.);
  }

  template <class Written> void expect_same(const Grains &read, const Written &written)
  {
    EXPECT_EQ(read.position, written.position);
    EXPECT_EQ(read.velocity, written.velocity);
    EXPECT_EQ(read.spin, written.spin);
    EXPECT_EQ(read.radius, written.radius);
    EXPECT_EQ(read.mass, written.mass);
  }

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
    expect_same(file.grains, written);
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
    cell.periodicity = PeriodicWidth{20};
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

  // --- grains from a snapshot file

  // Two stages. The second has three grains between platens at -1 and 5, and four contacts in an arbitrary order.
  struct StoredFile
  {
    std::vector<double> radius = {0.5, 1., 0.75}, mass = {1., 4., 2.25}, rotation = {0.1, 0.2, 0.3}, spin = {-1., 0., 1. / 3};
    std::vector<Eigen::Vector2d> position = {{0, 0}, {1. / 7, 2}, {-1, M_PI}}, velocity = {{1, 0}, {0, 1}, {0.1, 0.2}};
    std::vector<int>             body = {1, 2, 0, 3, 0, 1, 2, 4}, fixed = {};
    std::vector<double>          impulse = {0.25, -0.125, 0.5, 0., 0., 0., 1., 0.75};
    double                       lower_y = -1;

    void write() const
    {
      Hdf5Writer file(h5);
      for (const std::string group : {"stage_0000", "stage_0001"})
        {
          file.write(group + "/grains/position", position, 3);
          file.write(group + "/grains/velocity", velocity, 3);
          file.write(group + "/grains/rotation", rotation);
          file.write(group + "/grains/spin", spin);
          file.write(group + "/grains/radius", group == "stage_0000" ? std::vector<double>{3., 3., 3.} : radius);
          file.write(group + "/grains/mass", mass);
          if (!fixed.empty())
            file.write(group + "/grains/fixed", fixed);
          if (!body.empty())
            {
              file.write(group + "/contacts/body", body);
              file.write(group + "/contacts/impulse", impulse, {impulse.size() / 2, 2});
            }
          file.attribute(group, "lower_y", lower_y);
          file.attribute(group, "upper_y", 5);
          file.attribute(group, "mean_diameter", 1.5);
          file.attribute(group, "step", 0.02);
          file.attribute(group, "time", group == "stage_0000" ? 0. : 4.);
        }
      file.finish();
    }
  };

  std::string stored_complaint(const StoredFile &stored, const int stage = -1)
  {
    stored.write();
    return complaint(h5, [&] { read_grains_hdf5(h5, stage); });
  }

  TEST(GrainsFromSnapshots, TheLastStageIsReadExactlyByDefault)
  {
    const StoredFile stored;
    stored.write();
    const GrainFile file = read_grains_hdf5(h5), first = read_grains_hdf5(h5, 0);
    expect_same(file.grains, stored);
    EXPECT_EQ(file.grains.rotation, stored.rotation);
    EXPECT_EQ(file.grains.fixed, (std::vector<std::uint8_t>{0, 0, 0}));
    EXPECT_EQ(file.stage->number, 1);
    EXPECT_EQ(file.stage->time, 4);
    EXPECT_EQ(file.stage->step, 0.02);
    EXPECT_EQ(file.stage->lower_y, -1);
    EXPECT_EQ(file.stage->upper_y, 5);
    EXPECT_EQ(file.stage->mean_diameter, 1.5);
    EXPECT_EQ(first.stage->number, 0);
    EXPECT_EQ(first.grains.radius[0], 3);
    EXPECT_EQ(file.place(2), h5 + ", grain 2 (counted from 0)");
  }

  // The open contact (0, 1) is left out. The others ascend in (i, j).
  TEST(GrainsFromSnapshots, ImpulsesComeAsTheStateKeepsThem)
  {
    StoredFile stored;
    stored.write();
    const std::vector<PairImpulse> impulses = read_grains_hdf5(h5).stage->impulses;
    ASSERT_EQ(impulses.size(), 3u);
    const int    bodies[3][2]   = {{0, 3}, {1, 2}, {2, 4}};
    const double expected[3][2] = {{0.5, 0.}, {0.25, -0.125}, {1., 0.75}};
    for (int k = 0; k < 3; ++k)
      {
        EXPECT_EQ(impulses[k].i, bodies[k][0]);
        EXPECT_EQ(impulses[k].j, bodies[k][1]);
        EXPECT_EQ(impulses[k].normal, expected[k][0]);
        EXPECT_EQ(impulses[k].tangential, expected[k][1]);
      }
    stored.body.clear();
    stored.write();
    EXPECT_TRUE(read_grains_hdf5(h5).stage->impulses.empty());
  }

  // Force (3, 4) on grain 0 from grain 1 below it: normal (0, 1), tangent (-1, 0). In a step of 1/8 the impulses are 4/8 and
  // -3/8.
  TEST(GrainsFromSnapshots, FilesOfAPanelAreRead)
  {
    Snapshot s;
    s.step     = 0.125;
    s.upper_y  = 3;
    s.position = {{0, 2}, {0, 1}};
    s.velocity = s.displacement = s.applied_force = {{0.1, 0.2}, {0, 0}};
    s.rotation = s.spin = s.mean_spin_term = {0.5, -0.5};
    s.radius                               = {0.5, 0.5};
    s.mass                                 = {0.75, 0.75};
    s.internal_moment = s.mean_internal_moment = {2, Eigen::Matrix2d::Identity()};
    s.rattler                                  = {0, 0};
    s.fixed                                    = {0, 0};
    s.contacts                                 = {{0, 1, {0, 1.5}, {0, 1}, {3, 4}}};
    s.gap                                      = {0.};
    s.status                                   = {ContactStatus::sticking};
    write_snapshots(samples / "panel", {s});
    const GrainFile file = read_grains_hdf5(samples / "panel.h5");
    EXPECT_EQ(file.grains.position, s.position);
    EXPECT_EQ(file.grains.velocity, s.velocity);
    EXPECT_EQ(file.grains.spin, s.spin);
    EXPECT_EQ(file.stage->upper_y, 3);
    ASSERT_EQ(file.stage->impulses.size(), 1u);
    EXPECT_EQ(file.stage->impulses[0].normal, 0.5);
    EXPECT_EQ(file.stage->impulses[0].tangential, -0.375);
  }

  TEST(GrainsFromSnapshots, FixedGrainsStayFixed)
  {
    StoredFile stored;
    stored.fixed = {1, 0, 2};
    stored.write();
    EXPECT_EQ(read_grains_hdf5(h5).grains.fixed, (std::vector<std::uint8_t>{1, 0, 2}));
    stored.fixed = {1, 0, 4};
    EXPECT_EQ(stored_complaint(stored), ", dataset 'stage_0001/grains/fixed': entry 2 = 4; allowed: 0 (free), 1 (held), 2 or 3 "
                                        "(part of the lower or upper platen)");
  }

  TEST(GrainsFromSnapshots, AMissingStageIsNamed)
  {
    EXPECT_EQ(stored_complaint({}, 2), ": holds no stage 2; allowed: 0 to 1, or -1 for the last");
    EXPECT_EQ(stored_complaint({}, -2), ": holds no stage -2; allowed: 0 to 1, or -1 for the last");
    Hdf5Writer file(h5);
    file.finish();
    EXPECT_EQ(complaint(h5, [&] { read_grains_hdf5(h5); }), ": holds no group stage_0000; is it a result file of a panel?");
  }

  TEST(GrainsFromSnapshots, ImpossibleDatasetsAreNamed)
  {
    const auto refused = [](const std::string &fault, const std::function<void(StoredFile &)> &spoil) {
      StoredFile stored;
      spoil(stored);
      EXPECT_EQ(stored_complaint(stored), fault);
    };
    const std::string grains = ", dataset 'stage_0001/grains/", contacts = ", dataset 'stage_0001/contacts/";
    refused(grains + "spin': 2 entries; allowed: 3", [](StoredFile &f) { f.spin.pop_back(); });
    refused(grains + "position': 2 entries; allowed: 3", [](StoredFile &f) { f.position.pop_back(); });
    refused(grains + "radius': entry 1 (counted from 0) = -1 is out of range; allowed: 1e-12 to 1e12",
            [](StoredFile &f) { f.radius[1] = -1; });
    refused(grains + "velocity': entry 2 (counted from 0) = nan is out of range; allowed: -1e+12 to 1e12",
            [](StoredFile &f) { f.velocity[2].y() = NAN; });
    refused(grains + "mass': entry 0 (counted from 0) = 0; allowed: more than 0", [](StoredFile &f) { f.mass[0] = 0; });
    refused(contacts + "impulse': 3 entries; allowed: 4", [](StoredFile &f) { f.impulse.resize(6); });
    // three grains and at most four walls: bodies 0 to 6
    refused(contacts + "body': row 1 (counted from 0) = 0, 7; allowed: 0 to 2, and a larger number up to 6",
            [](StoredFile &f) { f.body[3] = 7; });
    refused(", attribute 'upper_y' of 'stage_0001' = 5 is out of range; allowed: 6 to 1e12",
            [](StoredFile &f) { f.lower_y = 6; });
  }

  TEST(GrainsFromSnapshots, AbsentDatasetsAndAttributesAreNamed)
  {
    Hdf5Writer file(h5);
    file.write("stage_0000/grains/radius", std::vector<double>{1.});
    file.attribute("stage_0000", "step", 1.);
    file.finish();
    expect_refused({h5, "stage_0000/grains/position"}, [] { read_grains_hdf5(h5); });
  }

  // --- time tables

  TEST(TimeTableFile, OneColumnOfSeveralIsRead)
  {
    write_text(csv, "time,force,velocity\n-1,7,0\n0,8,2\n4,9,-2\n");
    const TimeTable table = read_time_table(csv, "velocity");
    EXPECT_EQ(table.time, (std::vector<double>{-1, 0, 4}));
    EXPECT_EQ(table.value, (std::vector<double>{0, 2, -2}));
    EXPECT_EQ(table.at(1), 1); // a quarter of the way from 2 to -2
  }

  TEST(TimeTableFile, EveryFaultIsNamed)
  {
    for (const auto &[text, fault] : {std::pair{"time,force\n0,1\n", "line 1: column 'velocity' is missing"},
                                      {"velocity\n0\n", "line 1: column 'time' is missing"},
                                      {"time,velocity\n0,1\n2,1\n2,1\n",
                                       "line 4: column 'time' = '2' is out of range; allowed: more than 2, the time before it"}})
      {
        write_text(csv, text);
        expect_refused({csv + ", " + fault}, [] { read_time_table(csv, "velocity"); });
      }
  }
} // namespace
