// diptych: Python binding of snapshots, as NumPy arrays that share their memory
// SPDX-License-Identifier: LGPL-2.1-or-later
#include <memory>
#include <string>

#include "continuum/snapshot_fields.h"
#include "coupling/python/arrays.h"
#include "coupling/python/bindings.h"
#include "discrete/snapshot_fields.h"

namespace diptych::python
{
  namespace
  {
    // Contacts of the last step, or mean forces over the stage.
    struct ContactList
    {
      std::shared_ptr<const discrete::Snapshot> owner;
      bool                                      is_window = false;

      const std::vector<discrete::ContactForce> &entries() const { return is_window ? owner->window_forces : owner->contacts; }
    };

    std::string last_part(const std::string &path)
    {
      return path.substr(path.find_last_of('/') + 1);
    }

    template <class T> std::string shape_text()
    {
      std::string text = "(n";
      for (const long extent : Layout<T>::extents())
        text += ", " + std::to_string(extent);
      return text + ")";
    }

    // Binds a property for every list of `fields(snapshot, visit)`, named by the last part of the path.
    template <class Class, class Fields> void bind_lists(Class &type, const Fields &fields)
    {
      using Snapshot = typename Class::type;
      Snapshot prototype;
      fields(prototype, [&](const std::string &path, auto &member, const char *unit, const char *meaning) {
        using Value            = typename std::decay_t<decltype(member)>::value_type;
        const std::string text = shape_text<Value>() + " [" + unit + "]: " + meaning;
        type.def_property_readonly(
          last_part(path).c_str(),
          [fields, path](const py::object &self) {
            py::array found;
            fields(self.cast<const Snapshot &>(), [&](const std::string &name, const auto &values, const char *, const char *) {
              if (name == path)
                found = view(values, self);
            });
            return found;
          },
          text.c_str());
      });
    }

    py::object single(const double value)
    {
      return py::float_(value);
    }
    template <class E, std::enable_if_t<std::is_enum_v<E>, int> = 0> py::object single(const E value)
    {
      return py::str(discrete::name_of(value));
    }
    template <class Number, int rows, int columns> py::object single(const Eigen::Matrix<Number, rows, columns> &value)
    {
      return copy(value);
    }

    template <class Class> void bind_attributes(Class &type)
    {
      using Snapshot = typename Class::type;
      Snapshot prototype;
      visit_attributes(prototype, [&](const std::string &name, auto &, const char *unit, const char *meaning) {
        const std::string text = std::string("[") + unit + "]: " + meaning;
        type.def_property_readonly(
          name.c_str(),
          [name](const Snapshot &self) {
            py::object found;
            visit_attributes(self, [&](const std::string &one, const auto &value, const char *, const char *) {
              if (one == name)
                found = single(value);
            });
            return found;
          },
          text.c_str());
      });
    }

    template <class Member>
    void bind_contact_member(py::class_<ContactList> &type,
                             const char              *name,
                             Member discrete::ContactForce::*member,
                             const char                     *text)
    {
      type.def_property_readonly(
        name, [member](const py::object &self) { return member_view(self.cast<const ContactList &>().entries(), member, self); },
        text);
    }

    void bind_contacts(py::module_ &m)
    {
      py::class_<ContactList> type(m, "Contacts",
                                   "Pairs of bodies with the force between them. Grains are numbered from 0, walls after the "
                                   "grains. Arrays are read only and share the memory of their snapshot.");
      bind_contact_member(type, "i", &discrete::ContactForce::i, "(n): first body, a grain");
      bind_contact_member(type, "j", &discrete::ContactForce::j, "(n): second body, a grain or a wall");
      bind_contact_member(type, "point", &discrete::ContactForce::point, "(n, 2) [length]: contact point");
      bind_contact_member(type, "normal", &discrete::ContactForce::normal, "(n, 2) [-]: unit vector from j to i");
      bind_contact_member(type, "force", &discrete::ContactForce::force, "(n, 2) [pressure length]: on i");
      bind_contact_member(type, "shift", &discrete::ContactForce::shift,
                          "(n) [length]: x of the image of j that touches i minus x of j");
      bind_contact_member(type, "couple", &discrete::ContactForce::couple,
                          "(n) [pressure length^2]: couple on i, counter-clockwise; the opposite acts on j");
      type.def("__len__", [](const ContactList &list) { return list.entries().size(); });
      const auto beside = [&](const char *name, const bool of_window, const char *text, const auto &values) {
        type.def_property_readonly(
          name,
          [name, of_window, values](const py::object &self) {
            const auto &list = self.cast<const ContactList &>();
            if (list.is_window != of_window)
              throw py::attribute_error(std::string(name) + " is only known for snapshot." + (of_window ? "window" : "contacts"));
            return view((*list.owner).*values, self);
          },
          text);
      };
      beside("gap", false, "(n) [length]: distance of the surfaces; negative: penetration", &discrete::Snapshot::gap);
      beside("status", false, "(n): 0 open, 1 sticking, 2 slipping", &discrete::Snapshot::status);
      beside("dissipation", true, "(n) [pressure length^2]: by friction, over the stage",
             &discrete::Snapshot::window_dissipation);
      beside("impact_dissipation", true, "(n) [pressure length^2]: along the normal, over the stage",
             &discrete::Snapshot::window_impact_dissipation);
    }

    void bind_grain_snapshot(py::module_ &m)
    {
      using discrete::Snapshot;
      py::class_<Snapshot, std::shared_ptr<Snapshot>> type(
        m, "DiscreteSnapshot",
        "One instant of the grains. Stress is positive in compression. Arrays are read only and share its memory.");
      bind_lists(type, [](auto &s, auto &&visit) { discrete::visit_grain_fields(s, visit); });
      bind_attributes(type);
      type.def("__len__", [](const Snapshot &s) { return s.radius.size(); });
      type.def_property_readonly(
        "contacts",
        [](const std::shared_ptr<Snapshot> &s) {
          return ContactList{s, false};
        },
        "Candidate contacts of the last step; open contacts carry no force.");
      type.def_property_readonly(
        "window",
        [](const std::shared_ptr<Snapshot> &s) {
          return ContactList{s, true};
        },
        "Every pair that touched since the previous stage, with its mean force (sum of impulses / time).");
      const auto side = [&](const char *name, std::vector<Eigen::Vector2d> discrete::Outline::*member) {
        type.def_property_readonly(
          name, [member](const py::object &self) { return view(self.cast<const Snapshot &>().outline.*member, self); },
          "(m, 2) [length]: side of the outline of the sample, upward");
      };
      side("outline_left", &discrete::Outline::left);
      side("outline_right", &discrete::Outline::right);
    }

    // Cell values are members of a struct, so each property is a strided view.
    void bind_continuum_snapshot(py::module_ &m)
    {
      using continuum::CellState;
      using continuum::Snapshot;
      py::class_<Snapshot, std::shared_ptr<Snapshot>> type(m, "ContinuumSnapshot",
                                                           "One instant of the continuum. Stress and strain are positive in "
                                                           "compression. Arrays are read only and share its memory.");
      bind_lists(type, [](auto &s, auto &&visit) { continuum::visit_node_fields(s, visit); });
      bind_attributes(type);
      type.def_property_readonly(
        "cells", [](const py::object &self) { return view(self.cast<const Snapshot &>().cells, self); },
        continuum::cells_meaning);
      type.def_property_readonly(
        "law_variables",
        [](const py::object &self) {
          py::dict variables;
          for (const continuum::LawVariable &one : self.cast<const Snapshot &>().variables)
            variables[py::str(one.name)] = view(one.of_cells, self);
          return variables;
        },
        "dict: state variables of a law from a library, law.NAME -> (n) of the cells");
      CellState prototype;
      continuum::visit_cell_fields(prototype, [&](const std::string &path, auto &member, const char *unit, const char *meaning) {
        using Value            = std::decay_t<decltype(member)>;
        const auto        at   = reinterpret_cast<const char *>(&member) - reinterpret_cast<const char *>(&prototype);
        const std::string text = shape_text<Value>() + " [" + unit + "]: of the cells, " + meaning;
        const std::string name = last_part(path);
        type.def_property_readonly(
          name == "area" ? "cell_area" : name.c_str(), // `area` is the area of the sample
          [at](const py::object &self) {
            const std::vector<CellState> &cells = self.cast<const Snapshot &>().cell_state;
            const auto *first = reinterpret_cast<const Value *>(reinterpret_cast<const char *>(cells.data()) + at);
            return strided_view(first, cells.size(), sizeof(CellState), self);
          },
          text.c_str());
      });
    }
  } // namespace

  void bind_snapshots(py::module_ &m)
  {
    bind_contacts(m);
    bind_grain_snapshot(m);
    bind_continuum_snapshot(m);
  }
} // namespace diptych::python
