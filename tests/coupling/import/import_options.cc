// diptych: options of the import command
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "tests/coupling/import/foreign_files.h"

namespace
{
  using namespace diptych::coupling;
  using namespace diptych::coupling::foreign_files;

  TEST(ImportOptions, OptionsWithoutEffectAreRefused)
  {
    const auto refused = [](const char *name, const std::function<void(ForeignOptions &)> &change, const std::string &why) {
      const Case     c       = case_of(name);
      ForeignOptions options = options_of(c);
      change(options);
      const std::string refusal = refusal_of(c, options);
      EXPECT_NE(refusal.find(why), std::string::npos) << name << ": " << refusal;
    };
    for (const char *name : {"yade", "lmgc90", "mercurydpm", "csv"})
      refused(
        name, [](auto &o) { o.timestep = 1e-6; }, "--timestep would have no effect");
    for (const char *name : {"yade", "lmgc90", "mercurydpm", "csv"})
      refused(
        name, [](auto &o) { o.columns = {"contacts=i,j,fx,fy"}; }, "--columns contacts=i,j,fx,fy would have no effect");
    refused(
      "lammps", [](auto &o) { o.columns = {"walls=step,width"}; }, "every file of walls names its columns");
    for (const char *text : {"contacts", "contacts=", "grains=id,x,y", "=a"})
      refused(
        "lammps", [&](auto &o) { o.columns = {text}; }, "is not KIND=NAME");
    refused(
      "lammps", [](auto &o) { o.density = 2600; }, "--density would have no effect");
    refused(
      "csv",
      [](auto &o) {
        o.pressure = 1000;
        o.files    = {path_of("plain_csv/particles_0.csv"), path_of("plain_csv/walls.csv")};
      },
      "--pressure would have no effect");
  }

  // The last number in a file name is the frame; particles_0.csv has frame 0.
  TEST(ImportOptions, ContactsWithoutAFrameNumberAreReported)
  {
    const Case     c = case_of("csv");
    const Scratch  scratch;
    ForeignOptions options;
    options.files = {path_of("plain_csv/particles_0.csv"), path_of("plain_csv/walls.csv"),
                     scratch.write("contacts_c.csv", text_of_file(path_of("plain_csv/contacts_0.csv")))};
    EXPECT_NE(refusal_of(c, options).find("contacts_c.csv: its name contains no frame number"), std::string::npos)
      << refusal_of(c, options);
  }

  TEST(ImportOptions, WallsTouchOnlyWhereAWallHasNoPlace)
  {
    const Case     c       = case_of("csv");
    ForeignOptions options = options_of(c);
    options.walls_touch    = true;
    EXPECT_NE(refusal_of(c, options).find("--walls-touch would have no effect"), std::string::npos) << refusal_of(c, options);
  }
} // namespace
