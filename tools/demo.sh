# The demo of ./run, which sources this file and whose functions and variables it uses.

# Each picture and number of the demo comes from the commands a user would type.
run_demo() {
  install_packages build
  build hmlfc_cli
  local hmlfc=$build/tools/hmlfc out=$root/out/demo
  rm -rf "$out"
  mkdir -p "$out"

  say "Rendering a light field"
  "$hmlfc" synth --scene cards --grid 9x9 --size 512x384 -o "$out/views"
  local profile options begin microseconds=()
  for profile in main extended; do
    options=()
    if [[ $profile == extended ]]; then options=(--preset fast); fi
    say "Encoding it in profile $profile and checking the stream against the views"
    # Full chroma: the cards have saturated edges, which halved chroma blurs.
    "$hmlfc" encode "$out/views" -o "$out/cards-$profile.hmlfc" --profile "$profile" --chroma 444 \
      --target-psnr 38 "${options[@]}" --json >"$out/cards-$profile.json"
    begin=${EPOCHREALTIME//[.,]/}
    "$hmlfc" decode "$out/cards-$profile.hmlfc" -o "$out/decoded-$profile"
    microseconds+=($((${EPOCHREALTIME//[.,]/} - begin)))
  done
  say "Drawing pictures of profile extended"
  demo_pictures "$hmlfc" "$out"
  say "Rendering novel views on an orbit"
  "$hmlfc" render "$out/cards-extended.hmlfc" --path orbit --frames 36 --size 384x288 -o "$out/orbit" \
    --preview "$out/orbit.png" >"$out/orbit.txt"
  demo_table_head
  demo_table_row main "$out/cards-main.json" "${microseconds[0]}"
  demo_table_row extended "$out/cards-extended.json" "${microseconds[1]}"
  printf '\n%s\n' "$(cat "$out/orbit.txt")"
  printf 'Look through it in a browser: ./run view %s\n' "${out#"$root/"}/cards-extended.hmlfc"
}

demo_table_head() {
  printf '\n%-9s %10s %9s %9s %10s %10s %10s %10s\n' \
    profile bytes bpp ratio 'PSNR RGB' 'PSNR Y' encoding decoding
}

# demo_table_row PROFILE JSON MICROSECONDS: what encode measured, and how long decoding took.
demo_table_row() (
  profile=$1 json=$2 microseconds=$3
  export LC_ALL=C
  value() { sed -n "s/^ *\"$1\": \([^,]*\),*$/\1/p" "$json"; }
  printf '%-9s %10d %9.4f %9s %7.2f dB %7.2f dB %8.2f s %8.2f s\n' "$profile" \
    "$(value bytes)" "$(value bpp)" "$(printf '1 : %.1f' "$(value ratio)")" \
    "$(value psnr_rgb)" "$(value psnr_y)" "$(value seconds)" \
    "$((microseconds / 1000000)).$(printf %06d $((microseconds % 1000000)))"
)

# demo_pictures HMLFC OUT: one decoded view, all decoded views as a contact sheet, and where the
# decoded middle view differs from the rendered one.
demo_pictures() {
  local hmlfc=$1 out=$2
  "$hmlfc" picture view "$out/decoded-extended" --view 4,4 -o "$out/view.png"
  "$hmlfc" picture sheet "$out/decoded-extended" -o "$out/sheet.png"
  "$hmlfc" picture difference "$out/views" "$out/decoded-extended" --view 4,4 -o "$out/difference.png"
}
