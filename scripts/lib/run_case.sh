# Case files: which there are, and how one is run. To be sourced after setup.sh.
# shellcheck shell=bash

shipped_cases=$SYNOVIA_SOURCE_DIR/miniapps/cases

# A line for each shipped case: its name and its title.
list_cases()
{
   local file
   for file in "$shipped_cases"/*.toml
   do
      # Mesh scripts may have left it there.
      [[ $file != *.frames.toml ]] || continue
      printf '%-24s %s\n' "$(basename "$file" .toml)" \
         "$(sed -n 's/^title = "\(.*\)"$/\1/p' "$file")"
   done
}

# Whether a word can't be anything else.
is_case()
{
   [[ $1 == *.toml || -f $shipped_cases/$1.toml ]]
}

# The file of a case that is called by its file or, if it is shipped, by name.
find_case()
{
   local shipped=$shipped_cases/${1%.toml}.toml
   if [[ -f $1 ]]
   then
      echo "$1"
   elif [[ $1 != */* && -f $shipped ]]
   then
      echo "$shipped"
   else
      die "there is no case file '$1'" \
         "scripts/run --list lists those of miniapps/cases."
   fi
}

# Makes the mesh, runs $case_file with the programs in $build_dir, and draws;
# returns the exit status of synovia.
run_case()
{
   local settings=() status=0 i
   for ((i = 0; i < ${#options[@]}; i++))
   do
      case ${options[i]} in
         --set) settings+=("${options[i + 1]:-}") ;;
         --set=*) settings+=("${options[i]#*=}") ;;
      esac
   done
   "$SYNOVIA_PYTHON" "$SYNOVIA_SCRIPTS/lib/case_mesh.py" "$case_file" \
      "${settings[@]}" || return
   [[ -z $output ]] || options+=(--output "$output")
   "${mpirun[@]}" "$build_dir/miniapps/synovia" "$case_file" \
      "${options[@]}" || status=$?
   if ((status == 0)) && ! [[ " ${options[*]} " == *" --check "* ]]
   then
      : "${output:=$("$SYNOVIA_PYTHON" "$SYNOVIA_SCRIPTS/lib/case_output.py" \
         "$case_file" "${settings[@]}")}"
      draw_case
      say "results are in $output"
   fi
   return "$status"
}

# A report on $output, and the pictures of a shipped case.
draw_case()
{
   # In finite deformation a case has the pictures of its namesake.
   local name units=()
   name=$(basename "$case_file" .toml)
   local file=$SYNOVIA_SCRIPTS/plot_${name%_finite}.py
   if [[ $case_file -ef $shipped_cases/$(basename "$case_file") ]]
   then
      units=(--units "mm,N,s")
   else
      file=
   fi
   "$SYNOVIA_PYTHON" "$SYNOVIA_SCRIPTS/report.py" "$output" "${units[@]}" ||
      warn "there is no report (see above)"
   [[ ! -f $file ]] || "$SYNOVIA_PYTHON" "$file" "$output" ||
      warn "$(basename "$file") drew nothing (see above)"
}
