// diptych: result files of a calibration
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/calibration/calibration_output.h"

#include <sstream>

#include "coupling/calibration/calibration_numbers.h"
#include "coupling/numbers/number_json.h"
#include "coupling/scene/keys.h"
#include "coupling/version.h"
#include "discrete/files/text_file.h"

namespace diptych::coupling
{
  namespace
  {
    template <class Record> void write_json(const std::string &file, const Record &record)
    {
      nlohmann::json root = nlohmann::json::object();
      NumbersToJson  writer{root, 1};
      list_numbers(record, writer);
      discrete::write_text(file, root.dump(1) + "\n");
    }

    std::string table_of(const CalibrationRecord &record)
    {
      std::ostringstream csv;
      csv.precision(10);
      csv << "path,use,kind,from,to,count,mean,deviation,deviation_of_mean,before,after,parameter_deviation,half_step,counts\n";
      for (const PathRecord &path : record.paths)
        for (const ObservableRecord &o : path.observables)
          csv << path.name << ',' << path.use << ',' << o.kind << ',' << o.from << ',' << o.to << ',' << o.count << ',' << o.mean
              << ',' << o.deviation << ',' << o.deviation_of_mean << ',' << o.before << ',' << o.after << ','
              << o.parameter_deviation << ',' << o.half_step << ',' << o.counts << '\n';
      return csv.str();
    }

    std::string fragment_of(const CalibrationRecord &record)
    {
      std::ostringstream text;
      text << "# " << record.title << ", by diptych " << git_revision << (record.status == "finished" ? "" : ": " + record.status)
           << '\n';
      for (const PathRecord &path : record.paths)
        if (path.use == "fit")
          {
            text << "# fitted on " << path.name << ", seeds";
            for (const int seed : path.seeds)
              text << ' ' << seed;
            text << '\n';
          }
      text << "subsection continuum\n";
      for (const Entry &entry : record.settings)
        text << "  set " << entry.key << " = " << entry.value << '\n';
      for (const OwnValue &one : record.own)
        text << "  # " << one.target << ": set " << one.key << " = " << text_of(one.value) << '\n';
      text << "end\n";
      return text.str();
    }
  } // namespace

  void write_calibration(const std::string &directory, const CalibrationRecord &record)
  {
    write_json(directory + "/calibration.json", record);
    write_json(directory + "/calibration_cost.json", CalibrationCost{record.cpu_s, record.grains_cpu_s});
    discrete::write_text(directory + "/calibration.csv", table_of(record));
    discrete::write_text(directory + "/calibrated.prm", fragment_of(record));
  }
} // namespace diptych::coupling
