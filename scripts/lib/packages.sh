# System packages. To be sourced after common.sh.
# shellcheck shell=bash

# missing_packages FILE...: the packages of these lists that are not installed,
# one a line.
missing_packages()
{
   local -A installed=()
   local name status line choice
   while read -r name status
   do
      [[ $status != "ii" ]] || installed[$name]=1
   done < <(dpkg-query -W -f '${Package} ${db:Status-Abbrev}\n' 2>/dev/null)
   while read -r line
   do
      [[ -n $line && $line != \#* ]] || continue
      for choice in ${line//|/ }
      do
         [[ -z ${installed[$choice]:-} ]] || continue 2
      done
      echo "${line%%|*}"
   done < <(cat "$@")
}

as_root()
{
   if ((EUID == 0)); then env "$@"; else sudo env "$@"; fi
}

# install_packages FILE...: those of these lists.
install_packages()
{
   if ! have dpkg-query || ! have apt-get
   then
      warn "this is not Debian; the packages of $* are taken to be there"
      return
   fi
   local missing
   mapfile -t missing < <(missing_packages "$@")
   if ((${#missing[@]} > 0))
   then
      say "installing packages: ${missing[*]}"
      local advice="by hand: apt-get install ${missing[*]}"
      ((EUID == 0)) || have sudo ||
         die "neither root nor sudo, so packages cannot be installed" \
            "Have an administrator do it $advice"
      advice="Mend the machine's apt, or install $advice"
      # Another installation may be under way, or one was interrupted.
      local apt=(DEBIAN_FRONTEND=noninteractive apt-get -y
         -o DPkg::Lock::Timeout=600 -o Acquire::Retries=3)
      as_root DEBIAN_FRONTEND=noninteractive dpkg --configure -a ||
         warn "dpkg has an unfinished installation; leaving it to apt"
      as_root "${apt[@]}" update ||
         warn "apt-get update failed; trying with the lists there are"
      as_root "${apt[@]}" --fix-broken --no-install-recommends install \
         "${missing[@]}" || die "apt-get could not install the packages" \
         "$advice" "Synovia's package names are those of Debian 12."
      mapfile -t missing < <(missing_packages "$@")
      ((${#missing[@]} == 0)) ||
         die "packages are still missing: ${missing[*]}" "$advice"
   fi
}

check_blas()
{
   local blas
   blas=$(readlink -f "/usr/lib/$(gcc -print-multiarch)/libblas.so.3")
   [[ $blas == *openblas* ]] ||
      warn "the BLAS in use is $blas, which is slow; choose OpenBLAS with" \
         "update-alternatives --config libblas.so.3-$(gcc -print-multiarch)"
}
