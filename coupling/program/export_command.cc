// diptych: export FOLDER: our prepared sample as a start for other codes
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/program/commands.h"

#include <filesystem>

#include "coupling/import/exported_sample.h"
#include "coupling/scene/scene_file.h"
#include "coupling/store/file_names.h"
#include "coupling/store/provenance.h"
#include "coupling/store/result_folder.h"
#include "discrete/files/text_file.h"
#include "discrete/panel/snapshot_file.h"

namespace diptych::coupling
{
  namespace
  {
    // As it was named, without a slash behind; "." has a name in the folder above.
    std::string folder_beside(const std::string &folder)
    {
      namespace fs         = std::filesystem;
      const fs::path named = fs::path(folder + "/").lexically_normal().parent_path();
      return named.empty() || named.filename() == "." || named.filename() == ".." ? fs::canonical(folder).string()
                                                                                  : named.string();
    }
  } // namespace

  int export_sample(const CommandLine &line)
  {
    namespace fs = std::filesystem;
    if (!fs::is_directory(line.target))
      throw SceneError(line.target + " is not a result folder; diptych run SCENE makes one");
    const std::string file = discrete_h5(line.target);
    if (!fs::exists(file))
      throw SceneError(line.target + ": has no discrete.h5; diptych discrete or run makes it");
    Scene scene;
    if (const std::string prm = scene_prm(line.target); fs::exists(prm))
      scene = fs::exists(import_json(line.target)) && !is_resolved_scene(prm)
                ? read_scene(prm, {}, false) // what an import proposes
                : read_computed_scene(prm, {}, false);
    const std::vector<discrete::Snapshot> snapshots = discrete::read_snapshots(file);
    check_files(line.target, "discrete");
    if (std::size_t(line.exported.stage) >= snapshots.size())
      throw SceneError("--stage " + std::to_string(line.exported.stage) + ": " + file + " holds " +
                       std::to_string(snapshots.size()) + " snapshots, 0 to " + std::to_string(snapshots.size() - 1));
    if (line.exported.format == "dump" && line.exported.stage != 0)
      throw SceneError("--stage " + std::to_string(line.exported.stage) + ": a dump holds all stages; leave --stage out");
    const ExportedFiles files  = exported_sample(line.exported.format, scene, snapshots, line.exported.stage);
    const std::string   folder = line.output.empty() ? folder_beside(line.target) + "_for_" + line.exported.format : line.output;
    if (std::error_code none; fs::equivalent(folder, line.target, none))
      throw SceneError("--output " + folder + ": is the result folder itself; name a new folder");
    for (const auto &[name, text] : files)
      if (fs::exists(folder + "/" + name))
        throw SceneError("--output " + folder + ": " + name + " exists; name a new folder");
    return writing(folder, [&](FolderLock &) {
      for (const auto &[name, text] : files)
        {
          make_folder(fs::path(folder + "/" + name).parent_path().string());
          discrete::write_text(folder + "/" + name, text);
        }
      say(line, "written to " + folder);
      return done;
    });
  }
} // namespace diptych::coupling
