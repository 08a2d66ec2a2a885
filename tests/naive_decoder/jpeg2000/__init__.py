"""A JPEG 2000 decoder (ITU-T T.800) for the codestreams that KEY-2 and EXT-6 allow, and no others."""
