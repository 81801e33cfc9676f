#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# GNU parallel: runs a study in 8 shards of one thread each, as many at a time as there are cores, or with --sshlogin on several
# machines that share a file system. A shard that fails is tried once more.
set -euo pipefail
parallel --will-cite --retries 2 salebra study study.toml -o run.h5 --quiet --threads 1 --shard {}/8 ::: {1..8}
salebra study study.toml -o run.h5 --merge --quiet
