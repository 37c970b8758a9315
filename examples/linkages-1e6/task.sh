#!/bin/sh
# One task of a Slurm array: computes its share of the data set. Submit it with
#   sbatch --array=1-16 --export=ALL,SHARDS=16 task.sh
# again after failures (finished parts are skipped), and at the end run
#   python linkages.py -o linkages --join
#SBATCH --job-name=linkages
#SBATCH --cpus-per-task=1
#SBATCH --requeue
#SBATCH --output=task-%a.log

exec python linkages.py -o linkages --mechanisms "${MECHANISMS:-1000000}" --shard "$SLURM_ARRAY_TASK_ID/$SHARDS" --processes 1
