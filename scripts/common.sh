# What the scripts share; sourced, not run.
root="$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)"

fail() {
  echo "$*" >&2
  exit 1
}

# Whole seconds as "45 s" or "3 min 05 s".
duration() {
  if (($1 < 100)); then echo "$1 s"; else printf '%d min %02d s\n' $(($1 / 60)) $(($1 % 60)); fi
}

# Open MPI refuses to run as root unless told twice; in a container there is often nobody else.
allow_mpi_as_root() {
  if [ "$(id -u)" -eq 0 ]; then
    export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
  fi
}

# Parallel jobs of a build: two, or as many as LAMPBLACK_JOBS says.
jobs() { echo "${LAMPBLACK_JOBS:-2}"; }

# Linear algebra libraries start a thread a core in each rank; here each rank is one thread.
export OMP_NUM_THREADS="${OMP_NUM_THREADS:-1}" OPENBLAS_NUM_THREADS="${OPENBLAS_NUM_THREADS:-1}"

# For a build without a terminal. Reads what ninja prints: passes on what says something, and says every so many seconds ($1)
# how far it is. NINJA_STATUS has to be "[%f/%t] ".
build_progress() {
  local line begin=$SECONDS next=$1 elapsed done all
  while IFS= read -r line; do
    if [[ "$line" =~ ^\[([0-9]+)/([0-9]+)\] ]]; then
      done=${BASH_REMATCH[1]} all=${BASH_REMATCH[2]} elapsed=$((SECONDS - begin))
      if [ "$elapsed" -ge "$next" ] && [ "$done" -lt "$all" ]; then
        echo "Built $done of $all files, about $(duration $(((all - done) * elapsed / done))) to go"
        next=$((elapsed + $1))
      fi
    elif [[ ! "$line" =~ ^(ninja: |-- ) ]]; then
      printf '%s\n' "$line"
    fi
  done
}
