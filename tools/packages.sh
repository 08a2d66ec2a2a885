# The Debian packages that ./run installs, which sources this file and whose functions and variables it uses.

# debian_release: 12 up to Debian 12 and elsewhere, 13 from Debian 13 on.
debian_release() {
  local id version
  id=$(sed -n 's/^ID=//p' /etc/os-release) version=$(sed -nE 's/^VERSION_ID="?([0-9]+).*/\1/p' /etc/os-release)
  if [[ $id == debian ]] && ((${version:-13} >= 13)); then echo 13; else echo 12; fi
}

# packages GROUP...: the names listed for any of these groups, in this release, one a line.
packages() {
  local group
  for group in "$@"; do
    awk -v group="$group" -v release="$(debian_release)" \
      '!/^#/ && index("," $2 ",", "," group ",") {
        names = split($1, name, "|")
        chosen = release > 12 && names > 1 ? name[2] : name[1]
        if (chosen != "-") print chosen
      }' "$root/.ci/packages.txt"
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
