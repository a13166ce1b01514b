# For scripts that store results: what they are named by.
# shellcheck shell=bash

# This machine, as part of a file's name: its graphics processor, if NVIDIA's driver tells one, its
# processor and threads.
machine_name() {
  local gpu model
  gpu=$(nvidia-smi --query-gpu=name --format=csv,noheader 2>/dev/null | head -n 1 || true)
  model=$(sed -n 's/^model name[^:]*: *//p' /proc/cpuinfo | head -n 1)
  printf '%s%s-%s-threads' "${gpu:+$gpu }" "${model:-unknown}" "$(nproc)" |
    tr -cs '[:alnum:]-' '-'
}

# What the working tree holds.
revision() {
  git describe --always --dirty 2>/dev/null || echo unknown
}
