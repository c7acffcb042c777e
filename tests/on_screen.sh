#!/usr/bin/env bash
# Runs a command on a virtual screen of its own: windows of tests that run at once would take the keyboard from each
# other. Where there is no Xvfb the command runs as it is.
set -eu
command -v Xvfb > /dev/null || exec "$@"
ready=$(mktemp -u)
mkfifo "$ready"
Xvfb -displayfd 3 -screen 0 1600x1000x24 -nolisten tcp 3> "$ready" 2> /dev/null &
server=$!
trap 'kill "$server"; rm -f "$ready"' EXIT
read -r number < "$ready" || { echo "$0: Xvfb does not start" >&2; exit 1; }
DISPLAY=:$number "$@"
