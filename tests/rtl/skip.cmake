# cmake -DREASON=text -P skip.cmake: a test that cannot run here, for SKIP_REGULAR_EXPRESSION.
message("SKIPPED: ${REASON}")
