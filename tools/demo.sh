# The demo of ./run, which sources this file and whose functions and variables it uses.

# What a user would type, on a scene. Ends with what to look at.
run_demo() {
  local hmlfc=$build/tools/hmlfc out=$root/out/demo begun=$SECONDS
  # CPU seconds of a server of 2023, divided by the cores.
  if [[ ! -x $hmlfc ]]; then say "Compiling hmlfc takes about $(duration $((420 / $(nproc)))) here, once."; fi
  say "The demo takes about $(duration $((45 / $(nproc))))."
  install_packages build
  build hmlfc_cli
  rm -rf "$out"
  mkdir -p "$out"

  say "Rendering a light field"
  "$hmlfc" synth --scene cards --grid 9x9 --size 512x384 -o "$out/views"
  say "Encoding it, and checking the stream against the views"
  # Full chroma: the cards have saturated edges, which halved chroma blurs.
  "$hmlfc" encode "$out/views" -o "$out/cards.hmlfc" --preset fast --chroma 444 --target-psnr 38
  say "Decoding it, and drawing where the middle view differs"
  "$hmlfc" decode "$out/cards.hmlfc" -o "$out/decoded"
  "$hmlfc" picture sheet "$out/decoded" -o "$out/sheet.png"
  "$hmlfc" picture difference "$out/views" "$out/decoded" --view 4,4 -o "$out/difference.png"
  say "Rendering novel views: a focus on the front, and an orbit"
  "$hmlfc" render "$out/cards.hmlfc" --aperture 2 --focus-at 256,300 -o "$out/focus.png"
  "$hmlfc" render "$out/cards.hmlfc" --path orbit --frames 36 --size 384x288 -o "$out/orbit" --preview "$out/orbit.png"
  out=${out#"$root/"}
  printf '\nDone in %s. Pictures: %s/focus.png, orbit.png (it moves), sheet.png, difference.png\n' \
    "$(duration $((SECONDS - begun)))" "$out"
  printf 'Now look through it in a browser: ./run view %s/cards.hmlfc\n' "$out"
}
