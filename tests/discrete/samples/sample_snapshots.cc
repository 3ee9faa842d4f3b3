// diptych: grains from snapshots and time tables read back exactly, or are refused with their place
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "tests/discrete/samples/sample_file_examples.h"

namespace
{
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
    EXPECT_EQ(file.grains.position, stored.position);
    EXPECT_EQ(file.grains.velocity, stored.velocity);
    EXPECT_EQ(file.grains.rotation, stored.rotation);
    EXPECT_EQ(file.grains.spin, stored.spin);
    EXPECT_EQ(file.grains.radius, stored.radius);
    EXPECT_EQ(file.grains.mass, stored.mass);
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
    file.finish();
    expect_refused({h5, "stage_0000/grains/position"}, [] { read_grains_hdf5(h5); });
  }

  TEST(GrainsFromSnapshots, ATruncatedOrMissingFileIsNamed)
  {
    StoredFile().write();
    std::filesystem::resize_file(h5, std::filesystem::file_size(h5) / 2);
    expect_refused({h5}, [] { read_grains_hdf5(h5); });
    expect_refused({samples / "none.h5"}, [] { read_grains_hdf5(samples / "none.h5"); });
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
