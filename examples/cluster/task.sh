#!/bin/sh
# One task of a Slurm array: computes its share of a batch. Submit it with
#   sbatch --array=1-100 --export=ALL,SHARDS=100 task.sh
# and again, for what is missing after failures, with
#   sbatch --array="$(hodograph shards missing parts --of 100)" --export=ALL,SHARDS=100 task.sh
#SBATCH --job-name=linkages
#SBATCH --cpus-per-task=1
#SBATCH --requeue
#SBATCH --output=task-%a.log

# As many threads as Slurm gives cores.
export RAYON_NUM_THREADS="${SLURM_CPUS_PER_TASK:-1}"

exec hodograph batch scene.json \
  --vary l_AB=60..120 --vary l_BC=200..300 --random "${MECHANISMS:-1000000}" --seed 7 \
  --steps 71 --find omega_3,alpha_3 \
  --per-part "${PER_PART:-10000}" --shard "$SLURM_ARRAY_TASK_ID/$SHARDS" -o parts/
