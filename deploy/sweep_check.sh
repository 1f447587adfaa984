#!/bin/bash
# shellcheck disable=SC2317,SC2004,SC2086  # functions are reached through a trap and by name; numbers have no spaces
# Shows what a sweep promises, with real servers on this machine:
#   kill    the client and one of two servers are killed five times each at random moments; the resumed sweep has the
#           lines of an undisturbed one, byte for byte apart from times
#   scale   two servers with one thread each take at most 0.65 of the time of one
#   twice   the same sweep twice: like measures and work; the frame times' ratios within 15 % for 90 % of the cases
# Usage: deploy/sweep_check.sh BIN_FOLDER [SPEC [kill|scale|twice]...]      needs jq; ports from $PORT, 51871
# Example: deploy/sweep_check.sh build/release/bin deploy/sweeps/all.textproto
set -euo pipefail

bin=$(realpath "${1:?folder of sundial and sundiald}")
spec=$(realpath "${2:-$(dirname "$0")/sweeps/all.textproto}")
shift $(($# < 2 ? $# : 2))
parts=("${@:-}")
[ -n "${parts[0]}" ] || parts=(kill scale twice)
port=${PORT:-51871}
addresses=("127.0.0.1:$port" "127.0.0.1:$((port + 1))")
work=$(mktemp -d)
seed=${SEED:-$RANDOM}
RANDOM=$seed
declare -a pids=("" "")
killer=""
client=""
failures=0

end_servers() {
  for i in 0 1; do
    [ -z "${pids[$i]}" ] || { kill -9 "${pids[$i]}" && wait "${pids[$i]}"; } 2>/dev/null || true
    pids[$i]=""
  done
}
tidy() {
  [ -z "$killer" ] || kill "$killer" 2>/dev/null || true
  [ -z "$client" ] || kill -9 "$client" 2>/dev/null || true
  [ ! -e "$work/victim" ] || kill -9 "$(cat "$work/victim")" 2>/dev/null || true
  end_servers
  rm -rf "$work"
}
trap tidy EXIT

# start INDEX [PREFIX...]: a server; its process is that of the prefix, which must exec it.
start() {
  local index=$1
  shift
  "$@" "$bin/sundiald" --listen "${addresses[$index]}" 2>>"$work/server$index.log" &
  pids[$index]=$!
  until "$bin/sundial" --server "${addresses[$index]}" scenes >/dev/null 2>&1; do
    kill -0 "${pids[$index]}"  # or it will never answer
  done
}
lines() { wc -l 2>/dev/null <"$1" || echo 0; }
sweep() {  # SERVERS RESULTS [OPTION...]
  "$bin/sundial" --server "$1" sweep "$spec" -o "$2" "${@:3}"
}
timed() {  # seconds that a command takes
  local before after
  before=$(date +%s.%N)
  "$@" >/dev/null
  after=$(date +%s.%N)
  jq -n "$after - $before"
}
without_times() {
  jq -cS 'del(.frame_ms, .frame_quartiles, .ratio_to_baseline, .ratio_quartiles, .repetitions,
              .passes[]?.gpu_ms, .passes[]?.quartiles)' "$1" | sort
}
alike() { cmp -s <(without_times "$1") <(without_times "$2"); }
verdict() {  # WHAT COMMAND...
  if "${@:2}"; then
    echo "good: $1"
  else
    echo "BAD:  $1"
    failures=$((failures + 1))
  fi
}
is_true() { jq -en "$1" >/dev/null; }
kill_dead() {  # returns when its port is free again
  kill -9 "$1"
  while kill -0 "$1" 2>/dev/null; do sleep 0.02; done
}
random_part() { jq -n "$1 * $RANDOM / 32768"; }  # of so many seconds

both="${addresses[0]},${addresses[1]}"

check_kill() {
  start 0
  start 1
  local whole
  whole=$(timed sweep "$both" "$work/whole.jsonl")
  echo "undisturbed: $(wc -l <"$work/whole.jsonl") cases in $whole s; seed $seed"

  # Moments are such that all fall into the sweep, which the killing makes longer.
  local longest killed=0
  longest=$(jq -n "$whole / 10")
  echo "${pids[1]}" >"$work/victim"
  pids[1]=""  # it is the killer's now
  (
    for n in 1 2 3 4 5; do
      sleep "$(random_part "$longest")"
      [ ! -e "$work/finished" ] || break
      kill_dead "$(cat "$work/victim")"
      "$bin/sundiald" --listen "${addresses[1]}" 2>>"$work/server1.log" &
      echo $! >"$work/victim"
      echo "$n" >"$work/servers_killed"
    done
  ) &
  killer=$!
  for _ in 1 2 3 4 5; do
    # Not by sweep(): what is killed must be the client, and not a shell that waits for it.
    "$bin/sundial" --server "$both" sweep "$spec" -o "$work/broken.jsonl" --resume --quiet &
    client=$!
    local before
    before=$(lines "$work/broken.jsonl")
    while [ "$(lines "$work/broken.jsonl")" -le "$before" ] && kill -0 $client 2>/dev/null; do sleep 0.02; done
    sleep "$(random_part "$longest")"
    ! kill -9 $client 2>/dev/null || killed=$((killed + 1))
    wait $client 2>/dev/null || true
    client=""
  done
  sweep "$both" "$work/broken.jsonl" --resume
  touch "$work/finished"
  wait "$killer" || true
  killer=""
  kill -9 "$(cat "$work/victim")" || true
  rm "$work/victim"
  end_servers
  echo "killed: the client $killed times, a server $(cat "$work/servers_killed") times"
  verdict "killed five times each" test "$killed$(cat "$work/servers_killed")" = 55
  verdict "the same lines as undisturbed" alike "$work/whole.jsonl" "$work/broken.jsonl"
}

check_scale() {
  start 0 env LP_NUM_THREADS=1 taskset -c 0
  local one two ratio
  one=$(timed sweep "${addresses[0]}" "$work/one.jsonl")
  end_servers
  start 0 env LP_NUM_THREADS=1 taskset -c 0
  start 1 env LP_NUM_THREADS=1 taskset -c 1
  two=$(timed sweep "$both" "$work/two.jsonl")
  end_servers
  ratio=$(jq -n "$two / $one")
  echo "one server $one s, two servers $two s: $ratio"
  verdict "two servers take at most 0.65 of one's time" is_true "$ratio <= 0.65"
  verdict "the same lines from one server and from two" alike "$work/one.jsonl" "$work/two.jsonl"
}

check_twice() {
  start 0
  sweep "${addresses[0]}" "$work/first.jsonl" >/dev/null
  sweep "${addresses[0]}" "$work/second.jsonl" >/dev/null
  end_servers
  verdict "measures and work are the same twice" alike "$work/first.jsonl" "$work/second.jsonl"
  local share
  share=$(jq -s 'map(select(.error | not)) | group_by(.case) |
                 map(map(.ratio_to_baseline) | max / min <= 1.15) | (map(select(.)) | length) / length' \
    "$work/first.jsonl" "$work/second.jsonl")
  echo "share of cases whose ratio differs by at most 15 %: $share"
  verdict "90 % of the ratios within 15 %" is_true "$share >= 0.9"
}

for part in "${parts[@]}"; do
  echo "--- $part"
  "check_$part"
done
exit $((failures > 0))
