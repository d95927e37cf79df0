# Set-up and build. To be sourced.
# shellcheck shell=bash

# shellcheck source=scripts/lib/common.sh
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"
# shellcheck source=scripts/lib/python.sh
source "$SYNOVIA_SCRIPTS/lib/python.sh"
# shellcheck source=scripts/lib/mfem.sh
source "$SYNOVIA_SCRIPTS/lib/mfem.sh"

# setup_all [LIST...]: sets MFEM_DIR and SYNOVIA_PYTHON; installs the packages
# of these lists of scripts/, too.
setup_all()
{
   take_lock 9 "$SYNOVIA_CACHE/lock"
   local lists=(packages.txt packages-python.txt "$@")
   install_packages "${lists[@]/#/$SYNOVIA_SCRIPTS/}"
   check_blas
   setup_python
   setup_mfem
   exec 9>&-
}

# How CMake calls ccache: paths relative to the sources, so that another clone
# finds what this one compiled, and with precompiled headers.
ccache_launcher()
{
   local setting launcher=env
   for setting in "BASEDIR=$SYNOVIA_SOURCE_DIR" NOHASHDIR=1 \
      SLOPPINESS=pch_defines,time_macros,include_file_mtime,include_file_ctime
   do
      launcher+=";CCACHE_$setting"
   done
   echo "$launcher;ccache"
}

# build DIRECTORY TARGET [CMAKE_ARGUMENT...]: nobody else builds there, or runs
# tests, until the calling script ends.
build()
{
   local directory=$1 target=$2
   shift 2
   take_lock 8 "$directory/lock"
   local arguments=("-DSYNOVIA_PYTHON=$SYNOVIA_PYTHON" "$@")
   # A build directory keeps the generator it was made with.
   [[ -f $directory/CMakeCache.txt ]] || arguments+=(-G Ninja)
   [[ -z $MFEM_DIR ]] || arguments+=("-DMFEM_DIR=$MFEM_DIR")
   ! have ccache ||
      arguments+=("-DCMAKE_CXX_COMPILER_LAUNCHER=$(ccache_launcher)")
   cmake -S "$SYNOVIA_SOURCE_DIR" -B "$directory" "${arguments[@]}" ||
      die "cannot configure $directory (see above)" \
         "If it was made with other tools, remove it and try again."
   # ccache compares the times of what a precompiled header includes.
   find "$directory" -name cmake_pch.hxx -exec touch -d 2000-01-01 {} +
   cmake --build "$directory" --target "$target" \
      --parallel "$(parallel_jobs)" ||
      die "the build in $directory failed (see above)"
}

# get_ready TARGET: sets build_dir, where that program is, and SYNOVIA_PYTHON.
get_ready()
{
   if [[ -n ${SYNOVIA_BUILD_DIR:-} ]]
   then
      build_dir=$SYNOVIA_BUILD_DIR
      setup_python_alone
   else
      build_dir=$SYNOVIA_SOURCE_DIR/build
      setup_all
      build "$build_dir" "$1" -DSYNOVIA_BUILD_MINIAPPS=ON
   fi
}
