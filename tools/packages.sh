# The Debian packages that ./run installs, which sources this file and whose functions and variables it uses.

# packages GROUP...: the names listed for any of these groups, one a line.
packages() {
  local group
  for group in "$@"; do
    awk -v group="$group" '!/^#/ && index("," $2 ",", "," group ",") { print $1 }' \
      "$root/.ci/packages.txt"
  done | sort -u
}

# missing_packages GROUP...: those of them that are not installed, one a line.
missing_packages() {
  local installed
  installed=$(dpkg-query -W -f '${db:Status-Status} ${Package}\n' | sed -n 's/^installed //p')
  packages "$@" | grep -vxF "$installed" || true
}

# install_packages GROUP...: installs what is missing, or says how and stops. Packages of the groups
# `test` and `unit` are for a build with tests.
install_packages() {
  if [[ " $* " == *" test "* ]]; then
    tests=ON
  elif [[ " $* " == *" unit "* ]]; then
    tests=unit
  fi
  if ! command -v dpkg-query >/dev/null; then
    say "Not a Debian system: make sure that the libraries of .ci/packages.txt are installed."
    return
  fi
  local missing as_root=()
  mapfile -t missing < <(missing_packages "$@")
  if ((${#missing[@]} == 0)); then return; fi
  local install=(apt-get -o DPkg::Lock::Timeout=600 install -y --no-install-recommends "${missing[@]}")
  if ((EUID != 0)); then
    if ! sudo -n true 2>/dev/null; then
      say "These packages are missing and only root can install them. Run this as root, then try again:"
      say "  ${install[*]}"
      exit 1
    fi
    as_root=(sudo -n)
  fi
  say "Installing packages: ${missing[*]}"
  as_root+=(env DEBIAN_FRONTEND=noninteractive)
  stage "apt-get update" "$root/build/packages.log" update_lists "${as_root[@]}"
  stage "apt-get install" "$root/build/packages.log" "${as_root[@]}" "${install[@]}"
  rm -f "$build/settings"  # so that the next build configures and finds them
}

# update_lists [COMMAND...]: apt-get update, run by COMMAND. While another program holds the lists, which
# the option DPkg::Lock::Timeout does not wait for, tries again for ten minutes.
update_lists() {
  local output tries
  for ((tries = 0; tries < 120; ++tries)); do
    if output=$("$@" apt-get update 2>&1); then return; fi
    if [[ $output != *"Could not get lock"* ]]; then break; fi
    printf 'Waiting for cache lock: %s\n' "$(grep -m 1 'Could not get lock' <<<"$output")"
    sleep 5
  done
  printf '%s\n' "$output"
  return 1
}
