# Releases of ./run, which sources this file and whose functions and variables it uses.

# run_pack_vectors [FOLDER]: packs the suite, if its files are those of the manifest.
run_pack_vectors() {
  install_packages build
  build hmlfc_cli
  "$build/tools/hmlfc" vectors lint --suite "$root/vectors" >&2
  pack_vectors "${1:-$root/out}"
}

# pack_vectors FOLDER: the suite and the licence as hmlfc-vectors-VERSION.tar.gz, the same bytes on
# every day and for every user, and its SHA-256 beside it.
pack_vectors() {
  local folder=$1 version name
  version=$(sed -n 's/^ *"vectors_version": "\(.*\)",$/\1/p' "$root/vectors/manifest.json")
  name=hmlfc-vectors-$version
  mkdir -p "$folder"
  LC_ALL=C tar --create --directory "$root" --transform "s,^vectors,$name,;s,^LICENSE,$name/LICENSE," \
    --sort=name --format=ustar --owner=0 --group=0 --numeric-owner --mtime=@0 --mode=u=rwX,go=rX \
    vectors LICENSE | gzip -n9 >"$folder/$name.tar.gz"
  (cd "$folder" && sha256sum "$name.tar.gz" | tee "$name.tar.gz.sha256")
}

# run_package [FOLDER]: the Debian packages (cmake/HmlfcPackages.cmake).
run_package() {
  local folder=${1:-$root/out/packages} made=$build/packages
  install_for_pages package
  build hmlfc_installed
  rm -rf "$made"
  (cd "$build" && stage cpack "$build/cpack.log" cpack -B "$made")
  mkdir -p "$folder"
  cp "$made"/*.deb "$folder"
  ls "$folder"/*.deb
}

# run_sbom [FILE]: what a build uses, with versions and purpose.
run_sbom() {
  exec "$(debian_python)" -B "$root/tools/release/sbom.py" "$root" "${1:-$root/out/sbom.json}"
}

# run_release [FOLDER]: all files of a release of this commit in a new FOLDER, and what is left to do with them.
run_release() {
  local folder=${1:-$root/out/release} version name
  version=$(sed -n 's/^  VERSION //p' "$root/CMakeLists.txt") name=hmlfc-$version
  if [[ -e $folder || -n $(git -C "$root" status --porcelain) ]]; then
    say "A release is one commit's, in a new folder: $folder exists, or something is not committed."
    exit 2
  fi
  run_pack_vectors "$folder" >/dev/null
  run_package "$folder" >/dev/null
  (run_sbom "$folder/$name.cdx.json") >/dev/null
  git -C "$root" archive --prefix="$name/" --output="$folder/$name.tar.gz" HEAD
  HMLFC_STATIC=ON stage wheel "$build/wheel.log" "$(debian_python)" -m pip wheel --no-build-isolation --no-deps -w "$folder" "$root"
  (tests=OFF; use_build static; build hmlfc_cli; cp "$build/tools/hmlfc" "$folder/$name-linux-$(uname -m)")
  (tests=OFF; use_build windows; build hmlfc_cli; cp "$build/tools/hmlfc.exe" "$folder/$name-windows-x86_64.exe")
  cp "$root/Containerfile" "$folder"
  (cd "$folder" && rm ./*.sha256 && sha256sum -- [!S]* | tee SHA256SUMS)
  say "Sign SHA256SUMS, tag this commit v$version, publish all of $folder with the tag, and the image of its Containerfile.
Packages are for this release of Debian; $name-linux-$(uname -m) runs on any Linux, the wheel where its name says."
}

# run_docs [FOLDER]: the reference of the API and the documents as a site.
run_docs() {
  install_packages docs
  exec "$(debian_python)" -B "$root/tools/release/site_pages.py" "$root" "${1:-$root/out/site}"
}
