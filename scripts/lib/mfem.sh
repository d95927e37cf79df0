# MFEM: one that is there, or built from Debian's source package. To be
# sourced after common.sh.
# shellcheck shell=bash

# Tried first, and known to work. Debian replaces it in time, and then a later
# one is taken, by the checksum of Debian's signed index.
mfem_known_version=4.9
mfem_known_file=mfem_4.9+ds.orig.tar.xz
mfem_known_path=pool/main/m/mfem/$mfem_known_file
mfem_known_sha256=a92dd6e6c519e708c158124bc605a83ddce476b46ff533c1537a4c555e0753a0

# The options that MFEM is built with. A change here makes set-up build it
# again.
mfem_options()
{
   local libraries
   libraries=/usr/lib/$(gcc -print-multiarch)
   printf '%s\n' -DCMAKE_BUILD_TYPE=Release -DBUILD_SHARED_LIBS=ON \
      -DMFEM_USE_MPI=ON -DMFEM_USE_METIS_5=ON -DMFEM_USE_SUITESPARSE=ON \
      -DMFEM_USE_LAPACK=ON -DMFEM_USE_ZLIB=ON -DMFEM_USE_MUMPS=ON \
      -DMUMPS_DIR=/usr "-DMUMPS_REQUIRED_PACKAGES=MPI;MPI_Fortran;METIS" \
      -DHYPRE_DIR=/usr -DHYPRE_INCLUDE_DIRS=/usr/include/hypre \
      "-DHYPRE_LIBRARIES=$libraries/libHYPRE.so" -DMETIS_DIR=/usr \
      -DMFEM_ENABLE_TESTING=OFF -DMFEM_ENABLE_EXAMPLES=OFF \
      -DMFEM_ENABLE_MINIAPPS=OFF
}

# Prefixes of finished builds in the cache, newest version first. An install
# without its stamp was interrupted.
cached_mfem()
{
   local prefix options
   options=$(mfem_options)
   for prefix in $(printf '%s\n' "$SYNOVIA_CACHE"/mfem-* | sort -rV)
   do
      if [[ $(cat "$prefix/.complete" 2>/dev/null) == "$options" ]]
      then
         echo "$prefix"
         return
      fi
   done
}

# Can CMake find an MFEM that has what Synovia needs? Its output goes to a log.
find_mfem()
{
   local probe=$SYNOVIA_CACHE/work/find-mfem
   rm -rf "$probe"
   mkdir -p "$probe"
   cmake -G Ninja -S "$SYNOVIA_SCRIPTS/lib/find_mfem" -B "$probe" "$@" \
      >"$probe/log" 2>&1
}

# Addresses of the Debian archives that this machine's apt is set up for.
debian_archives()
{
   # shellcheck disable=SC2016 # apt expands it
   local format='$(REPO_URI)' filter=('Created-By: Packages' 'Label: Debian')
   local uris
   uris=$(apt-get indextargets --format "$format" "${filter[@]}" 2>/dev/null)
   if [[ -z $uris ]]
   then
      # Minimal machines have no package lists.
      local state=$SYNOVIA_CACHE/work/apt/machine
      mkdir -p "$state/lists/partial" "$state/cache"
      local options=(-o "Dir::State::Lists=$state/lists"
         -o "Dir::Cache=$state/cache")
      apt-get "${options[@]}" update >&2 || true
      uris=$(apt-get "${options[@]}" indextargets --format "$format" \
         "${filter[@]}")
   fi
   # Some mirrors refuse two slashes in a row.
   sed 's|/*$||' <<<"$uris" | sort -u
}

checksum_fits() { echo "$2  $1" | sha256sum --check --status; }

# Sources of any MFEM >= 4.9 in Debian's unstable or testing, into the current
# directory; sets mfem_version and mfem_file. Apt verifies them by the
# archive's signature.
fetch_later_mfem()
{
   local archive=$1 suite key versions
   key=/usr/share/keyrings/debian-archive-keyring.gpg
   for suite in sid testing
   do
      local state=$SYNOVIA_CACHE/work/apt/$suite
      rm -rf "$state"
      mkdir -p "$state/lists/partial" "$state/cache/archives/partial"
      echo "deb-src $([[ ! -f $key ]] || echo "[signed-by=$key]")" \
         "$archive $suite main" >"$state/sources.list"
      local options=(-o "Dir::Etc::SourceList=$state/sources.list"
         -o Dir::Etc::SourceParts=/dev/null
         -o "Dir::State::Lists=$state/lists" -o "Dir::Cache=$state/cache"
         -o Acquire::Languages=none -o Acquire::Retries=3)
      apt-get "${options[@]}" update || continue
      versions=$(apt-cache "${options[@]}" showsrc --only-source mfem |
         sed -n 's/^Version: //p' | sort -rV)
      local version=${versions%%$'\n'*}
      mfem_version=${version%%[+~-]*}
      if [[ -z $version ]] ||
         ! dpkg --compare-versions "$mfem_version" ge 4.9
      then
         continue
      fi
      rm -f mfem_*.orig.tar.*
      # The archive's own patches are for its own layout; the plain sources do.
      apt-get "${options[@]}" source --download-only --tar-only \
         "mfem=$version" || continue
      mfem_file=$(echo mfem_*.orig.tar.*)
      [[ ! -f $mfem_file ]] || return 0
   done
   return 1
}

# MFEM's sources as a file; sets mfem_version and mfem_file.
fetch_mfem()
{
   local downloads=$SYNOVIA_CACHE/downloads archive archives
   mkdir -p "$downloads"
   cd "$downloads" || die "cannot enter $downloads"
   mfem_version=$mfem_known_version
   mfem_file=$mfem_known_file
   if [[ -f $mfem_file ]] && checksum_fits "$mfem_file" "$mfem_known_sha256"
   then
      return
   fi
   have apt-get || die "there is no MFEM >= 4.9, and no apt to get it with" \
      "Install MFEM with MPI, METIS, SuiteSparse and MUMPS, and set MFEM_DIR."
   archives=$(debian_archives)
   say "fetching the sources of MFEM"
   for archive in $archives
   do
      rm -f "$mfem_file.part"
      /usr/lib/apt/apt-helper download-file "$archive/$mfem_known_path" \
         "$PWD/$mfem_file.part" "SHA256:$mfem_known_sha256" || continue
      mv "$mfem_file.part" "$mfem_file"
      return
   done
   say "$mfem_known_file is not there any more; looking for a later one"
   for archive in $archives
   do
      ! fetch_later_mfem "$archive" || return 0
   done
   die "could not download the sources of MFEM >= 4.9" \
      "Tried the Debian archives of this machine's apt:" \
      "$(sed 's|//[^/]*@|//|' <<<"${archives:-none}")" \
      "Either mend the network or apt's sources (a Debian archive is needed)," \
      "or put $mfem_known_file into $downloads," \
      "or install MFEM >= 4.9 with MPI, METIS, SuiteSparse and MUMPS by" \
      "other means and set the environment variable MFEM_DIR to its prefix."
}

# Builds and installs MFEM into the cache; sets MFEM_DIR.
build_mfem()
{
   local mfem_version mfem_file work prefix options here=$PWD
   fetch_mfem
   cd "$here" || die "cannot go back to $here"
   prefix=$SYNOVIA_CACHE/mfem-$mfem_version
   work=$SYNOVIA_CACHE/work/mfem-$mfem_version
   say "building MFEM $mfem_version, once, in about ten minutes on two cores"
   if [[ ! -d $work/source ]]
   then
      rm -rf "$work"
      mkdir -p "$work/unpacked"
      tar -xf "$SYNOVIA_CACHE/downloads/$mfem_file" -C "$work/unpacked" \
         --strip-components=1 ||
         die "cannot unpack $SYNOVIA_CACHE/downloads/$mfem_file" \
            "Remove it and run scripts/setup again."
      mv "$work/unpacked" "$work/source"
   fi
   # An interrupted configuration is not worth mending; a build is.
   [[ -f $work/build/build.ninja ]] || rm -rf "$work/build"
   rm -rf "$prefix"
   options=$(mfem_options)
   local arguments
   mapfile -t arguments <<<"$options"
   if ! cmake -G Ninja -S "$work/source" -B "$work/build" \
      -DCMAKE_INSTALL_PREFIX="$prefix" "${arguments[@]}" ||
      ! cmake --build "$work/build" --parallel "$(parallel_jobs)" ||
      ! cmake --install "$work/build" >"$work/install.log"
   then
      die "MFEM $mfem_version does not build (see above)" \
         "If memory ran out, try again with SYNOVIA_JOBS=1. To start over," \
         "remove $work. An MFEM >= 4.9 of your own also does: set MFEM_DIR."
   fi
   echo "$options" >"$prefix/.complete"
   rm -rf "$SYNOVIA_CACHE/work"
   MFEM_DIR=$prefix
}

# Sets MFEM_DIR, empty if CMake finds MFEM by itself.
setup_mfem()
{
   if [[ -n ${MFEM_DIR:-} ]]
   then
      find_mfem -DMFEM_DIR="$MFEM_DIR" ||
         die "the MFEM in MFEM_DIR=$MFEM_DIR will not do:" \
            "$(grep -A6 'CMake Error' "$SYNOVIA_CACHE/work/find-mfem/log")" \
            "Unset MFEM_DIR to have one built."
   else
      MFEM_DIR=$(cached_mfem)
      if [[ -z $MFEM_DIR ]] && ! find_mfem
      then
         build_mfem
      fi
   fi
   export MFEM_DIR
}
