#!/usr/bin/env bash
# What the scripts say and do, with stand-ins for the package manager and for the program itself.
set -euo pipefail
root="$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)"
work="$(mktemp -d)"
trap 'rm -rf "$work"' EXIT
cd "$work"

check() { # check WHAT EXPECTED-CODE EXPECTED-TEXT COMMAND...
  local what="$1" code="$2" text="$3" status=0
  shift 3
  "$@" >output 2>&1 </dev/null || status=$?
  if [ "$status" -ne "$code" ] || { [ -n "$text" ] && ! grep -qF -- "$text" output; }; then
    echo "FAILED: $what: exit code $status (expected $code), expected text: $text"
    cat output
    exit 1
  fi
  echo "ok  $what"
}

# --- setup: a machine where nothing is installed and nobody may install.
mkdir bin
printf '#!/bin/sh\nexit 1\n' >bin/dpkg-query
printf '#!/bin/sh\nexit 1\n' >bin/sudo
printf '#!/bin/sh\necho 1000\n' >bin/id
chmod +x bin/*
check "setup names the command for an administrator" 1 "apt-get install -y --no-install-recommends ccache cmake" \
  env PATH="$work/bin:$PATH" "$root/scripts/setup"
# The same machine as root: it installs, asking nobody.
printf '#!/bin/sh\necho 0\n' >bin/id
printf '#!/bin/sh\necho "apt-get $*" >>"%s/apt.log"; touch "%s/done"\n' "$work" "$work" >bin/apt-get
printf '#!/bin/sh\n[ -e "%s/done" ] || exit 1\nshift\nfor p in "$@"; do echo "installed $p"; done\n' "$work" >bin/dpkg-query
chmod +x bin/*
check "setup installs as root without asking" 0 "All packages are installed." env PATH="$work/bin:$PATH" "$root/scripts/setup"
grep -q "install -y -qq --no-install-recommends ccache cmake" apt.log
check "setup is silent when nothing is missing" 0 "" env PATH="$work/bin:$PATH" "$root/scripts/setup"
[ ! -s output ]

# --- build without a terminal: how far it is, and what the compiler says.
progress() {
  source "$root/scripts/common.sh"
  { echo "ninja: Entering directory"; echo "[30/120] a.cpp"; sleep 2.1; echo "[40/120] b.cpp"; echo "b.cpp: warning: c"; echo "[41/120] d.cpp"; } |
    build_progress 2  # in whole seconds, of which the last line takes none
}
check "build says how far it is" 0 "Built 40 of 120 files, about " progress
[ "$(sed 's/about .* to go$/about/' output)" = $'Built 40 of 120 files, about\nb.cpp: warning: c' ] || { cat output; exit 1; }

# --- run: the program is a stand-in that refuses folders in use, as the real one does.
mkdir -p cases/flame results
echo "problem: flow" >cases/flame/deck.yaml
cat >program <<'PROGRAM'
#!/usr/bin/env bash
out="$4" force=no
for word in "$@"; do [[ "$word" != --force && "$word" != --restart ]] || force=yes; done
if [ -e "$out/run.json" ] && [ $force = no ]; then echo "$out: this folder holds a finished run already" >&2; exit 2; fi
mkdir -p "$out" && touch "$out/results.h5"
printf '{\n  "status": "done",\n  "ranks": 2,\n  "wall_time_s": 7.5,\n  "peak_memory_per_rank_bytes": 104857600\n}\n' >"$out/run.json"
echo "computed with: $*"
PROGRAM
chmod +x program
export LAMPBLACK_PROGRAM="$work/program" LAMPBLACK_RESULTS="$work/results"
run=("$root/scripts/run" --no-plots)
check "run computes and says what it cost" 0 "Cost      8 s wall time on 2 ranks, at most 100 MiB of memory a rank" \
  "${run[@]}" cases/flame/deck.yaml
check "run does the same run once" 0 "holds a finished run of this deck already" "${run[@]}" cases/flame
check "run takes another folder for other settings" 0 "flame-2 --ranks 2 --set a.b=1" "${run[@]}" cases/flame --set a.b=1
check "run finds that folder again" 0 "flame-2 holds a finished run" "${run[@]}" cases/flame --set a.b=1
check "run computes again with --force" 0 "results/flame --ranks 2 --force" "${run[@]}" cases/flame --force
check "run goes on in the same folder with --restart" 0 "results/flame --ranks 2 --restart" "${run[@]}" cases/flame --restart
check "run passes on the refusal of a folder that was asked for" 2 "this folder holds a finished run already" \
  "${run[@]}" cases/flame --set a.b=2 --out results/flame
check "run hands on the number of ranks" 0 "--out many --ranks 3" "${run[@]}" cases/flame --ranks 3 --out many
check "run names a deck that is not there" 2 "there is no such deck" "${run[@]}" cases/none
check "run refuses unknown options" 1 "unknown option --rank" "${run[@]}" cases/flame --rank 2
check "test refuses unknown options" 1 "unknown option --fast" "$root/scripts/test" --fast
