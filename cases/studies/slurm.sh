#!/usr/bin/env bash
# A study on a cluster with Slurm: its parts as an array of jobs, and a job behind them that merges.
#   cases/studies/slurm.sh PARTS STUDY.toml [--out DIR] [--again] [-- options of sbatch]
# for example, from a folder that all nodes share:
#   cases/studies/slurm.sh 16 cases/static/study_convergence.toml -- --cpus-per-task=8 --time=2:00:00 --partition=short
# The same by hand:
#   sbatch --array=1-16 --cpus-per-task=8 cases/studies/slurm.sh STUDY.toml
#   sbatch --dependency=afterany:JOB cases/studies/slurm.sh STUDY.toml
# The same again makes what is missing. PDPLATE names the program where it is not in PATH.
set -euo pipefail
program=${PDPLATE:-pdplate}
usage='usage: slurm.sh PARTS STUDY.toml [--out DIR] [--again] [-- options of sbatch]'

if [[ -n ${SLURM_ARRAY_TASK_ID:-} ]]; then  # a part
  exec "$program" study "$@" --part "$SLURM_ARRAY_TASK_ID/$SLURM_ARRAY_TASK_MAX" --threads "${SLURM_CPUS_PER_TASK:-1}"
elif [[ -n ${SLURM_JOB_ID:-} && ! ${1:-} =~ ^[0-9]+$ ]]; then  # all of them have ended
  exec "$program" study "$@" --merge
fi

parts=${1:-} study=${2:-}
if [[ ! $parts =~ ^[1-9][0-9]*$ || ! -f $study ]]; then
  printf '%s\n' "$usage" >&2
  exit 2
fi
shift 2
of_study=("$study") of_merge=("$study")
while [[ $# -gt 0 && $1 != -- ]]; do
  of_study+=("$1")
  [[ $1 == --again ]] || of_merge+=("$1")  # what is made need not be made for the merge
  shift
done
[[ $# -eq 0 ]] || shift  # --
array=$(sbatch --parsable --job-name=study "$@" --array="1-$parts" "$0" "${of_study[@]}")
merge=$(sbatch --parsable --job-name=merge "$@" --dependency="afterany:${array%%;*}" --cpus-per-task=1 "$0" "${of_merge[@]}")
printf 'parts: job %s, merge: job %s\n' "$array" "$merge"
