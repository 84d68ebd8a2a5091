#!/usr/bin/env bash
# For scripts to source: one line on standard error that tells how far something is, written over on a terminal;
# elsewhere a line at each quarter.

told=

progress() { # WHO WHAT PERCENT
  local percent=$3
  [ -t 2 ] || percent=$((percent / 25 * 25))
  [ "$2 $percent" != "$told" ] || return 0
  told="$2 $percent"
  if [ -t 2 ]; then printf '\r\033[K%s: %s, %d %%' "$1" "$2" "$percent" >&2; else printf '%s: %s, %d %%\n' "$1" "$2" "$percent" >&2; fi
}

# Takes the line away again, where it is still there.
progress_done() {
  if [ -n "$told" ] && [ -t 2 ]; then printf '\r\033[K' >&2; fi
  told=
}
