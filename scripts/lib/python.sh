# Python environment of meshes and plots. To be sourced after common.sh.
# shellcheck shell=bash

SYNOVIA_PYTHON=$SYNOVIA_CACHE/venv/bin/python
export SYNOVIA_PYTHON

setup_python()
{
   local venv=$SYNOVIA_CACHE/venv
   # The system's own, since another one in PATH may come and go.
   local python=/usr/bin/python3
   [[ -x $python ]] || python=$(command -v python3) ||
      die "there is no python3" "Install Python 3.11 or later with venv."
   local wanted
   wanted=$("$python" --version; cat "$SYNOVIA_SCRIPTS/requirements.txt")
   if [[ -x $SYNOVIA_PYTHON &&
      $(cat "$venv/.complete" 2>/dev/null) == "$wanted" ]]
   then
      return
   fi
   say "setting up the Python environment $venv"
   rm -rf "$venv"
   "$python" -m venv "$venv" ||
      die "$python cannot create a virtual environment" \
         "Install its venv module (Debian: apt-get install python3-venv)."
   "$SYNOVIA_PYTHON" -m pip install --disable-pip-version-check \
      --retries 5 -r "$SYNOVIA_SCRIPTS/requirements.txt" ||
      die "pip could not install scripts/requirements.txt" \
         "Check the network and pip's configuration (pip config list), and" \
         "run scripts/setup again."
   "$SYNOVIA_PYTHON" "$SYNOVIA_SCRIPTS/lib/check_python.py" ||
      die "the Python packages do not work here (see above)" \
         "Is a library of scripts/packages.txt missing?"
   echo "$wanted" >"$venv/.complete"
}
