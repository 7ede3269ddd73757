#!/usr/bin/env bash
# A study as an array of a real Slurm on this machine, whose tasks, controller and node are killed while it works: at the end every
# row must be there, with the bits of a run in one process. Wants root, Debian's packages (apt-get install slurm-wlm munge) and a Python
# with hamilcar; takes two minutes. Slurm runs from a folder of its own, beside whatever is configured in /etc, and ends with the script.
# Usage: python/tests/by_hand/slurm_array.sh [PYTHON]
set -euo pipefail
python=$(realpath -s "${1:-$(command -v python3)}")
place=$(mktemp -d)
study="$place/sweep of springs"
export SLURM_CONF="$place/slurm.conf"
mkdir "$place/state" "$place/spool"

cat > "$SLURM_CONF" <<END
ClusterName=one
SlurmctldHost=$(hostname -s)
SlurmUser=root
SlurmdUser=root
AuthType=auth/munge
AuthInfo=cred_expire=5
StateSaveLocation=$place/state
SlurmdSpoolDir=$place/spool
SlurmctldPidFile=$place/slurmctld.pid
SlurmdPidFile=$place/slurmd.pid
SlurmctldLogFile=$place/slurmctld.log
SlurmdLogFile=$place/slurmd.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
MpiDefault=none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
ReturnToService=2
SlurmdTimeout=10
BatchStartTimeout=5
NodeName=$(hostname -s) CPUs=2 State=UNKNOWN
PartitionName=all Nodes=ALL Default=YES State=UP
END

started_munge=no
end() {
  scancel --user=root 2>/dev/null || true
  sleep 1
  for name in slurmd slurmctld; do kill "$(cat "$place/$name.pid")" 2>/dev/null || true; done
  if [ $started_munge = yes ]; then kill "$(cat /run/munge/munged.pid)"; fi
}
trap end EXIT
if ! munge -n >/dev/null 2>&1; then
  install -d -o munge -g munge -m 755 /run/munge
  setpriv --reuid munge --regid munge --clear-groups munged
  started_munge=yes
fi
slurmctld && slurmd

# Waits at most three minutes for what the arguments say.
wait_until() {
  for _ in $(seq 900); do if "$@"; then return; fi; sleep 0.2; done
  echo "waited in vain for: $*" >&2
  exit 1
}
idle() { [ "$(sinfo --noheader --format=%t)" = idle ]; }
chunks() { find "$study" -name 'chunk_*' | wc -l; }
has_chunks() { [ "$(chunks)" -ge "$1" ]; }
running() { squeue --noheader --array --states=RUNNING --format=%A; }
is_running() { [ -n "$(running)" ]; }
all_over() { [ -z "$(squeue --noheader)" ]; }
processes_of() { scontrol listpids "$1" 2>/dev/null | awk 'NR > 1 && $1 > 1 { print $1 }' | sort -u; }
parents_of() { for process in "$@"; do ps -o ppid= -p "$process" || true; done | sort -u; }

wait_until idle
"$python" - "$study" <<'END'
import sys
from hamilcar.study import Parameter, Study, latin_hypercube
study = Study("bmw_323i", [Parameter("axle.front.spring.rate_N_per_m", 18e3, 30e3), Parameter("chassis.mass_kg", 900, 1300)],
              ["yaw rate gain", "steady roll angle"], maneuver="step_steer")
study.prepare(latin_hypercube(study.parameters, 160), sys.argv[1], chunk=4)
END
"$python" -m hamilcar.study submit "$study" --slurm --tasks 4 -- --cpus-per-task=1
wait_until has_chunks 4

one=$(running | head -1)
echo "$(chunks) chunks; killing the processes of task $one: it fails"
kill -KILL $(processes_of "$one")
wait_until has_chunks 10

echo "$(chunks) chunks; killing the controller: tasks go on without it"
kill -KILL "$(cat "$place/slurmctld.pid")"
before=$(chunks)
wait_until has_chunks $((before + 2))
slurmctld
wait_until is_running

echo "$(chunks) chunks; killing the node with all that runs there: Slurm queues its tasks again"
on_node=$(for job in $(running); do processes_of "$job"; done)
# With the step daemons, which are parents of the jobs' scripts and would report how these ended.
kill -KILL "$(cat "$place/slurmd.pid")" $(parents_of $on_node | while read -r parent; do
  [ "$(cat "/proc/$parent/comm")" = slurmstepd ] && echo "$parent"; done) $on_node
slurmd
wait_until all_over

grep -q -i requeu "$place/slurmctld.log" || { echo "expected Slurm to queue the node's tasks again" >&2; exit 1; }
"$python" -m hamilcar.study status "$study" && { echo "expected the failed task's chunks to be missing" >&2; exit 1; }
echo "submitting the array again, for the task that failed"
"$python" -m hamilcar.study submit "$study" --slurm --tasks 4
wait_until all_over
"$python" -m hamilcar.study status "$study"
"$python" -m hamilcar.study gather "$study" -o "$place/result.npz"
"$python" - "$study" "$place/result.npz" <<'END'
import sys
import numpy as np
from hamilcar.study import open_folder
study, found = open_folder(sys.argv[1]).study, np.load(sys.argv[2])
assert len(found["X"]) == 160 and len(np.unique(found["X"], axis=0)) == 160
assert np.isfinite(found["Y"]).all() and np.array_equal(found["Y"], study.evaluate(found["X"]))
print("160 rows, each once, with the bits of a run in one process")
END
