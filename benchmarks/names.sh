# For scripts that store results: what they are named by.
# shellcheck shell=bash

# This machine, as part of a file's name.
machine_name() {
  local model
  model=$(sed -n 's/^model name[^:]*: *//p' /proc/cpuinfo | head -n 1)
  printf '%s-%s-threads' "${model:-unknown}" "$(nproc)" | tr -cs '[:alnum:]-' '-'
}

# What the working tree holds.
revision() {
  git describe --always --dirty 2>/dev/null || echo unknown
}
