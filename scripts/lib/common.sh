# What all scripts share: strict mode, paths, messages, the environment of
# runs. To be sourced.
# shellcheck shell=bash

set -euo pipefail

SYNOVIA_SOURCE_DIR=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
SYNOVIA_SCRIPTS=$SYNOVIA_SOURCE_DIR/scripts

if [[ -z ${SYNOVIA_CACHE:-} ]]
then
   if [[ -n ${XDG_CACHE_HOME:-} ]]
   then
      SYNOVIA_CACHE=$XDG_CACHE_HOME/synovia
   elif [[ -n ${HOME:-} ]]
   then
      SYNOVIA_CACHE=$HOME/.cache/synovia
   else
      echo "synovia: error: neither HOME nor SYNOVIA_CACHE is set" >&2
      exit 1
   fi
fi
# CMake and pip keep paths, so a relative one would change its meaning.
[[ $SYNOVIA_CACHE == /* ]] || SYNOVIA_CACHE=$PWD/$SYNOVIA_CACHE
export SYNOVIA_SOURCE_DIR SYNOVIA_CACHE

say() { printf 'synovia: %s\n' "$*"; }
warn() { printf 'synovia: warning: %s\n' "$*" >&2; }
die()
{
   printf 'synovia: error: %s\n' "$1" >&2
   shift
   (($# == 0)) || printf '   %s\n' "$@" >&2
   exit 1
}

have() { command -v "$1" >/dev/null 2>&1; }

# The header comment of the calling script, from its second line on.
print_help()
{
   awk 'NR > 1 { if (!/^#/) exit; sub(/^# ?/, ""); print }' "$0"
}

# How many cores there are for us. nproc alone would answer with
# OMP_NUM_THREADS, which is 1 here for the sake of MPI.
cores()
{
   env -u OMP_NUM_THREADS nproc
}

# How many compilers to run at once: a file that includes mfem.hpp may take
# 1.5 GB, so memory may allow fewer than there are cores.
parallel_jobs()
{
   local cores memory
   cores=$(cores)
   memory=$(awk '/^MemAvailable:/ {print int($2 / 1500000)}' /proc/meminfo)
   ((memory >= 1)) || memory=1
   echo "${SYNOVIA_JOBS:-$((cores < memory ? cores : memory))}"
}

# Waits until nobody else holds the lock FILE, and takes it as file descriptor
# FD. It lives as long as the calling script and what that starts, unless it is
# closed: exec FD>&-.
take_lock()
{
   local fd=$1 file=$2
   mkdir -p "$(dirname "$file")" ||
      die "cannot create the directory $(dirname "$file")" \
         "Set SYNOVIA_CACHE to a directory that you may write to."
   eval "exec $fd>\"\$file\""
   flock -n "$fd" && return
   say "waiting for another run that holds $file"
   flock "$fd"
}

set -a
# shellcheck source=scripts/lib/run.env
source "$SYNOVIA_SCRIPTS/lib/run.env"
set +a

# Draw without a screen, and without VTK's complaint that there is none.
if [[ -z ${DISPLAY:-}${VTK_DEFAULT_OPENGL_WINDOW:-} ]]
then
   export VTK_DEFAULT_OPENGL_WINDOW=vtkEGLRenderWindow
fi
