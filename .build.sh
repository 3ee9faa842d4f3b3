# Sourced by run.sh and test.sh: the packages that they need from Debian 12 or 13, and how they build.
# deal.II of Debian 13 links by mold.

packages=(
  g++ cmake ninja-build ccache git ca-certificates libcli11-dev
  libdeal.ii-dev libsuitesparse-dev libopenblas0-serial libgmsh-dev libeigen3-dev libhdf5-openmpi-dev openmpi-bin nlohmann-json3-dev libgtest-dev mold
  python3 python3-h5py python3-matplotlib python3-jinja2 python3-dev python3-numpy pybind11-dev
  python3-scipy python3-pandas python3-mpi4py python3-meshio python3-emcee
)

# OpenMPI refuses to start as root, the usual user of a container.
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1

# A second checkout of the same sources finds what the first one has compiled.
export CCACHE_BASEDIR=$PWD

# install_missing: installs missing packages. Does not call apt if none is missing.
install_missing() {
  local missing=() package
  for package in "${packages[@]}"; do
    [ "$(dpkg-query -W -f='${Status}' "$package" 2>/dev/null)" = "install ok installed" ] || missing+=("$package")
  done
  [ ${#missing[@]} -eq 0 ] && return
  echo "installing: ${missing[*]}"
  local root=()
  [ "$(id -u)" -eq 0 ] || root=(sudo)
  "${root[@]}" apt-get update -qq
  "${root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends "${missing[@]}" >/dev/null
}

# Number of cores that this process may use. Plain nproc would return OMP_NUM_THREADS.
cores() {
  env -u OMP_NUM_THREADS -u OMP_THREAD_LIMIT nproc
}

# build PRESET TARGET...: at most one compiler per 2.5 GB of memory, the need of a deal.II unit.
build() {
  local preset=$1 jobs memory_gb log
  shift
  memory_gb=$(awk '/MemAvailable/ {print int($2 / 1048576)}' /proc/meminfo)
  jobs=$((memory_gb * 2 / 5))
  [ "$jobs" -ge 1 ] || jobs=1
  [ "$jobs" -le "$(cores)" ] || jobs=$(cores)
  log=$(mktemp)
  cmake --preset "$preset" >"$log" 2>&1 || { cat "$log"; return 1; }
  rm -f "$log"
  cmake --build --preset "$preset" -j "$jobs" --target "$@"
}
