// diptych: contact problems in the layout of FCLIB, any array of which was changed, or any byte
// SPDX-License-Identifier: LGPL-2.1-or-later
#include <cmath>
#include <limits>
#include <vector>

#include "discrete/files/hdf5_library.h"
#include "discrete/files/text_file.h"
#include "discrete/problem_files/fclib.h"
#include "discrete/solvers/solver.h"
#include "fuzz.h"

namespace
{
  using namespace diptych;

  // 100 grains, or twelve: three times as many inputs in the same time, and more of the bytes are the format's own.
  const std::string &whole_problem(const bool is_little)
  {
    static const std::string small  = discrete::read_text(DIPTYCH_SMALL_PROBLEM),
                             little = discrete::read_text(DIPTYCH_LITTLE_PROBLEM);
    return is_little ? little : small;
  }

  // Names of all datasets, in the order of the file.
  herr_t add_name(hid_t, const char *name, const H5O_info_t *info, void *names)
  {
    if (info->type == H5O_TYPE_DATASET)
      static_cast<std::vector<std::string> *>(names)->push_back(name);
    return 0;
  }

  constexpr double odd[] = {0,   1,    -1,  2,    NAN,   INFINITY, -INFINITY, 1e308, -1e308, 5e-324, 0.5,
                            1e9, -1e9, 3e9, 1e19, -1e19, 255.,     65536.,    7,     99,     1e-3,   -0.3};

  // One change: which array, what, where and to what. Five bytes.
  struct Edit
  {
    unsigned array, kind, place, value;
  };

  void write_array(const hid_t file, const std::string &name, const std::vector<double> &values, const bool whole)
  {
    const hsize_t n     = values.size();
    const hid_t   space = H5Screate_simple(1, &n, nullptr);
    const hid_t   set   = H5Dcreate2(file, name.c_str(), whole ? H5T_STD_I32LE : H5T_IEEE_F64LE, space, H5P_DEFAULT, H5P_DEFAULT,
                                     H5P_DEFAULT);
    H5Dwrite(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
    H5Dclose(set), H5Sclose(space);
  }

  void change(const hid_t file, const std::string &name, const Edit &edit)
  {
    const hid_t set = H5Dopen2(file, name.c_str(), H5P_DEFAULT);
    if (set < 0)
      return;
    const hid_t         space = H5Dget_space(set), type = H5Dget_type(set);
    const bool          whole = H5Tget_class(type) == H5T_INTEGER, number = whole || H5Tget_class(type) == H5T_FLOAT;
    std::vector<double> values(std::size_t(std::max<hssize_t>(0, H5Sget_simple_extent_npoints(space))));
    if (number)
      H5Dread(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
    H5Tclose(type), H5Sclose(space), H5Dclose(set);
    const double value = odd[edit.value % std::size(odd)];
    if (edit.kind % 6 == 0 && !values.empty())
      values[edit.place % values.size()] = value;
    else if (edit.kind % 6 == 1)
      values.resize(edit.place % (values.size() + 1));
    else if (edit.kind % 6 == 2)
      values.insert(values.end(), 1 + edit.place % 5, value);
    H5Ldelete(file, name.c_str(), H5P_DEFAULT);
    if (edit.kind % 6 != 5)
      write_array(file, name, values, edit.kind % 6 == 3 ? !whole : whole);
  }

  void change_arrays(const std::string &path, const std::string_view content)
  {
    const hid_t              file = H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
    std::vector<std::string> names;
    H5Ovisit2(file, H5_INDEX_NAME, H5_ITER_INC, add_name, &names, H5O_INFO_BASIC);
    const auto byte = [&](const std::size_t k) { return unsigned(std::uint8_t(content[k])); };
    for (std::size_t k = 0; k + 5 <= content.size() && k < 40; k += 5)
      change(file, names[byte(k) % names.size()], {byte(k), byte(k + 1), byte(k + 2) + 256 * byte(k + 3), byte(k + 4)});
    H5Fclose(file);
  }

  std::string change_bytes(std::string bytes, const std::string_view content)
  {
    const auto byte = [&](const std::size_t k) { return std::size_t(std::uint8_t(content[k])); };
    for (std::size_t k = 0; k + 4 <= content.size() && k < 40; k += 4)
      bytes[(byte(k) + 256 * byte(k + 1) + 65536 * byte(k + 2)) % bytes.size()] = content[k + 3];
    return bytes;
  }

  // A few sweeps over what was taken: indices are in range.
  void solve(const discrete::StoredProblem &problem)
  {
    if (!problem.bodies)
      return;
    discrete::SolverOptions options;
    options.max_sweeps = 3;
    std::vector<discrete::Impulse> impulses(problem.bodies->contacts.size());
    (void)discrete::solve(*problem.bodies, options, impulses);
  }
} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *data, const std::size_t size)
{
  static const fuzz::Folder folder;
  const fuzz::Choice        choice(data, size, 4);
  const std::string        &whole     = whole_problem(choice.way >= 2);
  const bool                of_arrays = choice.way % 2 == 0;
  const std::string         file      = folder.put("input.h5", of_arrays ? whole : change_bytes(whole, choice.content));
  if (of_arrays)
    change_arrays(file, choice.content);
  fuzz::is_taken(folder.path, [&] { solve(discrete::read_fclib(file)); });
  return 0;
}
