// diptych: result files of the discrete panel
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "discrete/panel/snapshot_file.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <type_traits>

#include "discrete/files/field_arrays.h"
#include "discrete/panel/snapshot_views.h"
#include "discrete/snapshot_fields.h"

namespace diptych::discrete
{
  namespace
  {
    const auto contact_fields = [](auto &entry, auto &&visit) { visit_contact_fields(entry, visit); };

    // Frames of another code may lack the couples, which are then NaN.
    bool has_couples(const std::vector<ContactForce> &contacts)
    {
      return std::none_of(contacts.begin(), contacts.end(), [](const ContactForce &c) { return std::isnan(c.couple); });
    }

    void write_contacts(Hdf5Writer &file, const std::string &group, const std::vector<ContactForce> &contacts)
    {
      std::vector<int> body;
      for (const ContactForce &c : contacts)
        body.insert(body.end(), {c.i, c.j});
      file.write(group + "/body", body, {contacts.size(), 2});
      file.attribute(group + "/body", "unit", "-");
      file.attribute(group + "/body", "meaning", contact_bodies);
      for_each_column(contacts, contact_fields,
                      [&](const std::string &name, const auto &values, const char *unit, const char *meaning) {
                        if (name != "couple" || has_couples(contacts))
                          write_field(file, group + "/" + name, values, unit, meaning);
                      });
    }

    void write_impulses(Hdf5Writer &file, const std::string &name, const Snapshot &s)
    {
      std::vector<double> impulse;
      for (const ContactForce &c : s.contacts)
        {
          const Eigen::Vector2d tangent(-c.normal.y(), c.normal.x());
          impulse.insert(impulse.end(), {s.step * c.force.dot(c.normal), s.step * c.force.dot(tangent)});
        }
      file.write(name, impulse, {s.contacts.size(), 2});
      file.attribute(name, "unit", "pressure length time");
      file.attribute(name, "meaning", contact_impulses);
    }

    // Fields that frames of another code may lack. They are NaN throughout and are not written; this attribute lists them.
    constexpr char missing_fields[] = "not_told";

    bool is_known(const double value)
    {
      return !std::isnan(value);
    }
    bool is_known(const Eigen::Vector2d &value)
    {
      return !value.array().isNaN().all();
    }
    bool is_known(const Eigen::Matrix2d &value)
    {
      return !value.array().isNaN().all();
    }
    template <class T> bool is_known(const std::vector<T> &values)
    {
      if constexpr (is_whole<T>)
        return true;
      else
        return values.empty() || std::any_of(values.begin(), values.end(), [](const T &value) { return is_known(value); });
    }

    template <class T> void set_unknown(std::vector<T> &values, const std::size_t n)
    {
      if constexpr (std::is_same_v<T, double>)
        values.assign(n, NAN);
      else if constexpr (!is_whole<T>)
        values.assign(n, T::Constant(NAN));
    }

    bool is_stored(const Snapshot &s, const std::string &name, const std::size_t size)
    {
      return name.rfind("window", 0) != 0 || size == s.window_forces.size();
    }

    void write_stage(Hdf5Writer &file, const std::string &group, const Snapshot &s)
    {
      std::string missing;
      const auto  write = [&](const std::string &name, const auto &values, const char *unit, const char *meaning) {
        if (is_known(values))
          write_field(file, group + "/" + name, values, unit, meaning);
        else
          missing += name + " ";
      };
      visit_grain_fields(s, write);
      visit_contact_lists(s, [&](const std::string &name, const std::vector<ContactForce> &contacts, const char *, const char *) {
        write_contacts(file, group + "/" + name, contacts);
        if (!has_couples(contacts))
          missing += name + "/couple ";
      });
      if (is_known(s.step))
        write_impulses(file, group + "/contacts/impulse", s);
      if (!missing.empty())
        file.attribute(group, missing_fields, missing);
      visit_contact_values(s, [&](const std::string &name, const auto &values, const char *unit, const char *meaning) {
        if (is_stored(s, name, values.size()))
          write(name, values, unit, meaning);
      });
      visit_outline(
        s, [&](const std::string &name, const std::vector<Eigen::Vector2d> &points, const char *unit, const char *meaning) {
          file.write(group + "/" + name, points);
          file.attribute(group + "/" + name, "unit", unit);
          file.attribute(group + "/" + name, "meaning", meaning);
        });
      visit_attributes(s, [&](const char *name, const auto &value, const char *, const char *) {
        if constexpr (std::is_same_v<std::decay_t<decltype(value)>, double>)
          file.attribute(group, name, value);
        else
          file.attribute(group, name, name_of(value));
      });
    }

    std::vector<ContactForce> read_contacts(const Hdf5Reader  &file,
                                            const std::string &group,
                                            const std::size_t  n_grains,
                                            const ArrayCheck  &check)
    {
      constexpr int          most_walls = 4;
      const std::string      list       = group.substr(group.find_last_of('/') + 1) + "/";
      const std::vector<int> body       = file.read_int(group + "/body");
      if (body.size() % 2 != 0)
        check.refuse(list + "body", "does not contain pairs");
      std::vector<ContactForce> contacts(body.size() / 2);
      for (std::size_t k = 0; k < contacts.size(); ++k)
        {
          contacts[k].i = body[2 * k];
          contacts[k].j = body[2 * k + 1];
          if (contacts[k].i < 0 || contacts[k].i >= int(n_grains) || contacts[k].j < 0 ||
              contacts[k].j >= int(n_grains) + most_walls || contacts[k].i == contacts[k].j)
            check.refuse(list + "body", "contains a body that does not exist, or the same body twice, in row " +
                                          std::to_string(k) + " (counted from 0)");
        }
      set_columns(contacts, contact_fields, [&](const std::string &name, auto &values) {
        using Value = typename std::decay_t<decltype(values)>::value_type;
        if ((name == "couple" || name == "image_shift_y") &&
            !file.has(group + "/" + name)) // files of earlier versions, or not told
          return values.resize(contacts.size());
        values = read_field<Value>(file, group + "/" + name);
        check.size(list + name, values.size(), contacts.size());
        check.finite(list + name, values);
      });
      return contacts;
    }

    // Checks that sizes are positive and normals have length 1 within the digits that other codes write.
    void check_values(const Snapshot &s, const ArrayCheck &check)
    {
      constexpr double digits   = 1e-3;
      const auto       is_above = [](const double x) { return !(x <= 0); };
      const auto       is_unit  = [](const ContactForce &c) {
        return c.normal.array().isNaN().all() || std::abs(c.normal.norm() - 1) < digits;
      };
      if (!std::all_of(s.radius.begin(), s.radius.end(), is_above) || !std::all_of(s.mass.begin(), s.mass.end(), is_above))
        check.refuse("grains", "contains a radius or a mass that is not above 0");
      visit_contact_lists(s, [&](const std::string &name, const std::vector<ContactForce> &contacts, const char *, const char *) {
        if (!std::all_of(contacts.begin(), contacts.end(), is_unit))
          check.refuse(name + "/normal", "contains a normal that is not of length 1");
      });
    }

    bool may_be(const double value, const std::string &name, const Meaning &meaning, const bool of_another_code)
    {
      if (std::isfinite(value))
        return true;
      if (std::isinf(value))
        return meaning.may_be_infinite;
      return meaning.may_be_nan || (of_another_code && !is_always_told(name));
    }

    void read_attributes(const Hdf5Reader &file, const std::string &group, const ArrayCheck &check, Snapshot &s)
    {
      const bool of_another_code = !file.has(group + "/contacts/impulse"); // imported frames have no step
      visit_attributes(s, [&](const char *name, auto &value, const char *, const Meaning &meaning) {
        using Value = std::decay_t<decltype(value)>;
        if (std::string(name).rfind("cell_a", 0) == 0 && !file.has_attribute(group, name)) // files of earlier versions
          return;
        if constexpr (std::is_same_v<Value, double>)
          {
            value = file.attribute(group, name);
            if (!may_be(value, name, meaning, of_another_code))
              check.refuse(name, "is not finite");
          }
        else if (const auto known = value_of<Value>(file.text_attribute(group, name)))
          value = *known;
        else
          check.refuse(name, "is not one of the allowed names");
      });
      if (!(s.mean_diameter > 0) || !(s.area > 0))
        check.refuse("mean_diameter or area", "is not above 0");
    }

    // The sides must be near grains and walls. No sample has an outline farther from their box than the box is large.
    void check_outline(const Snapshot &s, const ArrayCheck &check)
    {
      const std::vector<Eigen::Vector2d> &left = s.outline.left, &right = s.outline.right;
      if (!(left.front().x() < right.front().x() && left.back().x() < right.back().x()))
        check.refuse("outline", "has its left side to the right of its right side");
      Eigen::Array2d low(INFINITY, s.lower_y), high(-INFINITY, s.upper_y);
      for (std::size_t i = 0; i < s.position.size(); ++i)
        {
          low  = low.min(s.position[i].array() - s.radius[i]);
          high = high.max(s.position[i].array() + s.radius[i]);
        }
      for (const double wall : {s.left_x, s.right_x})
        if (std::isfinite(wall))
          {
            low.x()  = std::min(low.x(), wall);
            high.x() = std::max(high.x(), wall);
          }
      const double margin = (high - low).maxCoeff() + s.cell_width + s.cell_vectors.norm();
      visit_outline(s, [&](const std::string &name, const std::vector<Eigen::Vector2d> &points, const char *, const char *) {
        for (const Eigen::Vector2d &x : points)
          if ((x.array() < low - margin).any() || (x.array() > high + margin).any())
            check.refuse(name, "lies too far from grains and walls: farther than these are from each other");
      });
    }

    Snapshot read_stage(const Hdf5Reader &file, const std::string &group)
    {
      const ArrayCheck check{file.path() + ": " + group};
      Snapshot         s;
      read_attributes(file, group, check, s);
      const std::string missing = file.has_attribute(group, missing_fields) ? file.text_attribute(group, missing_fields) : "";
      visit_grain_fields(s, [&](const std::string &name, auto &values, const char *, const char *) {
        using Value = typename std::decay_t<decltype(values)>::value_type;
        if (name != "grains/position" && missing.find(name + " ") != std::string::npos && !file.has(group + "/" + name))
          return set_unknown(values, s.position.size());
        values = read_field<Value>(file, group + "/" + name);
        check.size(name, values.size(), s.position.size());
        check.finite(name, values);
      });
      if (s.position.empty())
        check.refuse("grains/position", "contains no grain");
      visit_contact_lists(s, [&](const std::string &name, std::vector<ContactForce> &contacts, const char *, const char *) {
        contacts = read_contacts(file, group + "/" + name, s.position.size(), check);
        if (missing.find(name + "/couple ") != std::string::npos)
          for (ContactForce &contact : contacts)
            contact.couple = NAN;
      });
      visit_contact_values(s, [&](const std::string &name, auto &values, const char *, const char *) {
        using Value          = typename std::decay_t<decltype(values)>::value_type;
        const bool of_window = name.rfind("window", 0) == 0;
        if (of_window && !file.has(group + "/" + name))
          return; // the dissipation of pairs is missing in some files
        values = read_field<Value>(file, group + "/" + name);
        check.size(name, values.size(), of_window ? s.window_forces.size() : s.contacts.size());
        check.finite(name, values);
      });
      visit_outline(s, [&](const std::string &name, std::vector<Eigen::Vector2d> &points, const char *, const char *) {
        points = file.read_vectors(group + "/" + name);
        check.finite(name, points);
        if (points.size() < 2)
          check.refuse(name, "contains fewer than two points");
      });
      check_values(s, check);
      check_outline(s, check);
      return s;
    }
  } // namespace

  SnapshotFile::SnapshotFile(const std::string &path)
      : stages(path),
        grains(path),
        contacts(path + "_contacts")
  {}

  SnapshotFile::SnapshotFile(const std::string &path, const std::size_t kept)
      : stages(path, kept),
        grains(path, progress_of_stages(path + ".h5", kept)),
        contacts(path + "_contacts", progress_of_stages(path + ".h5", kept))
  {}

  void SnapshotFile::add(const Snapshot &snapshot)
  {
    stages.add([&](Hdf5Writer &file, const std::string &group) { write_stage(file, group, snapshot); });
    grains.add(snapshot.progress, grains_of(snapshot));
    contacts.add(snapshot.progress, contacts_of(snapshot));
  }

  void SnapshotFile::close()
  {
    stages.close();
  }

  void write_snapshots(const std::string &path_without_ending, const std::vector<Snapshot> &snapshots)
  {
    SnapshotFile file(path_without_ending);
    for (const Snapshot &snapshot : snapshots)
      file.add(snapshot);
    file.close();
  }

  std::vector<Snapshot> read_snapshots(const std::string &h5_path)
  {
    const Hdf5Reader      file(h5_path, Hdf5Reader::From::this_program);
    const std::size_t     n = count_stages(file);
    std::vector<Snapshot> snapshots;
    for (std::size_t k = 0; k < n; ++k)
      snapshots.push_back(read_stage(file, stage_name(k)));
    return snapshots;
  }
} // namespace diptych::discrete
