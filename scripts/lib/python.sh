# Python environment of meshes and plots. To be sourced after common.sh.
# shellcheck shell=bash

# shellcheck source=scripts/lib/packages.sh
source "$SYNOVIA_SCRIPTS/lib/packages.sh"

# One that the caller names is taken as it is.
own_python=${SYNOVIA_PYTHON:-}
export SYNOVIA_PYTHON=${own_python:-$SYNOVIA_CACHE/venv/bin/python}

# Installs packages of the system too, but only if the environment isn't there.
setup_python()
{
   [[ -z $own_python ]] || return 0
   local venv=$SYNOVIA_CACHE/venv
   if [[ -x $SYNOVIA_PYTHON &&
      $(cat "$venv/.complete" 2>/dev/null) == "$(venv_recipe)" ]]
   then
      return
   fi
   install_packages "$SYNOVIA_SCRIPTS/packages-python.txt"
   local python
   python=$(system_python)
   [[ -n $python ]] ||
      die "there is no python3" "Install Python 3.11 or later with venv."
   say "setting up the Python environment $venv"
   rm -rf "$venv"
   "$python" -m venv "$venv" ||
      die "$python cannot create a virtual environment" \
         "Install its venv module (Debian: apt-get install python3-venv)."
   "$SYNOVIA_PYTHON" -m pip install --disable-pip-version-check \
      --retries 5 -r "$SYNOVIA_SCRIPTS/requirements.txt" ||
      die "pip could not install scripts/requirements.txt" \
         "Check the network and pip's configuration (pip config list), and" \
         "try again."
   "$SYNOVIA_PYTHON" "$SYNOVIA_SCRIPTS/lib/check_python.py" ||
      die "the Python packages do not work here (see above)" \
         "Is a library of scripts/packages-python.txt missing?"
   venv_recipe >"$venv/.complete"
}

# The system's own, since another one in PATH may come and go.
system_python()
{
   if [[ -x /usr/bin/python3 ]]
   then
      echo /usr/bin/python3
   else
      command -v python3 || true
   fi
}

# What an environment is made of: it is made anew when that changes.
venv_recipe()
{
   local python
   python=$(system_python)
   [[ -z $python ]] || "$python" --version
   cat "$SYNOVIA_SCRIPTS/requirements.txt"
}

# For scripts that need nothing but Python, and whose output is others' input.
setup_python_alone()
{
   [[ -z $own_python ]] || return 0
   take_lock 9 "$SYNOVIA_CACHE/lock" >&2
   setup_python >&2
   exec 9>&-
}
