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
