/* hmlfc_checker.h for Icarus Verilog, which has no DPI: each function hmlfc_checker_NAME is the
 * system function $hmlfc_checker_NAME with the same arguments; $hmlfc_checker_print(id) prints
 * hmlfc_checker_text(id). Build it with
 *   iverilog-vpi -IPREFIX/include hmlfc_vpi.c -LPREFIX/lib -lhmlfc_dpi */
#include <stdlib.h>
#include <string.h>
#include <vpi_user.h>

#include <hmlfc/hmlfc_checker.h>

#define MOST_ARGUMENTS 12
#define MOST_WORDS (HMLFC_CHECKER_STAGE_BITS / 32)

/* Arguments by kind: s a string, i an integer of up to 64 bits, v a vector that is read, o one that
 * is written. */
struct function {
  const char* name;
  const char* arguments;
};

enum { kOpen, kPrint, kRequest, kAnswer, kStage, kReset, kEnd, kUnknown, kExpected };

static const struct function kFunctions[] = {
    {"$hmlfc_checker_open", "ssi"},          {"$hmlfc_checker_print", "i"},
    {"$hmlfc_checker_request", "iiiiiiiii"}, {"$hmlfc_checker_answer", "iiiiv"},
    {"$hmlfc_checker_stage", "iiiiiiiiiiv"}, {"$hmlfc_checker_reset", "ii"},
    {"$hmlfc_checker_end", "iii"},           {"$hmlfc_checker_unknown", "iis"},
    {"$hmlfc_checker_expected", "iiiiiiio"}};

struct arguments {
  char* strings[2];
  long long numbers[MOST_ARGUMENTS];
  unsigned vector[2 * MOST_WORDS];
  vpiHandle output;
};

/* Words aval, bval of the vector `from`, and zeros behind it. */
static void read_vector(vpiHandle from, unsigned* words) {
  s_vpi_value value;
  const int count = (vpi_get(vpiSize, from) + 31) / 32;
  memset(words, 0, 2 * MOST_WORDS * sizeof(unsigned));
  value.format = vpiVectorVal;
  vpi_get_value(from, &value);
  for (int i = 0; i < count && i < MOST_WORDS; ++i) {
    words[2 * i] = (unsigned)value.value.vector[i].aval;
    words[2 * i + 1] = (unsigned)value.value.vector[i].bval;
  }
}

static long long read_number(vpiHandle from) {
  unsigned words[2 * MOST_WORDS];
  s_vpi_value value;
  if (vpi_get(vpiSize, from) <= 32) {
    value.format = vpiIntVal;
    vpi_get_value(from, &value);
    return value.value.integer;
  }
  read_vector(from, words);
  return (long long)((unsigned long long)words[2] << 32 | words[0]);
}

static char* read_string(vpiHandle from) {
  s_vpi_value value;
  value.format = vpiStringVal;
  vpi_get_value(from, &value);
  return strdup(value.value.str);
}

static int read_arguments(vpiHandle call, const char* kinds, struct arguments* a) {
  vpiHandle all = vpi_iterate(vpiArgument, call);
  int count = 0;
  int strings = 0;
  for (vpiHandle one; all != NULL && (one = vpi_scan(all)) != NULL; ++count) {
    switch (kinds[count]) {
      case 's':
        a->strings[strings++] = read_string(one);
        break;
      case 'i':
        a->numbers[count] = read_number(one);
        break;
      case 'v':
        read_vector(one, a->vector);
        break;
      case 'o':
        a->output = one;
        break;
      default:
        return 0;
    }
  }
  return kinds[count] == 0;
}

static void write_vector(vpiHandle to, const unsigned* words) {
  s_vpi_vecval vector[MOST_WORDS];
  s_vpi_value value;
  for (int i = 0; i < MOST_WORDS; ++i) {
    vector[i].aval = (PLI_INT32)words[2 * i];
    vector[i].bval = (PLI_INT32)words[2 * i + 1];
  }
  value.format = vpiVectorVal;
  value.value.vector = vector;
  vpi_put_value(to, &value, NULL, vpiNoDelay);
}

static int call_function(int which, struct arguments* a) {
  const long long* n = a->numbers;
  const int id = (int)n[0];
  int result = 0;
  switch (which) {
    case kOpen:
      return hmlfc_checker_open(a->strings[0], a->strings[1], (int)n[2]);
    case kPrint:
      vpi_printf("%s", hmlfc_checker_text(id));
      return 0;
    case kRequest:
      return hmlfc_checker_request(id, n[1], (int)n[2], (int)n[3], (int)n[4], (int)n[5], (int)n[6],
                                   (int)n[7], (int)n[8]);
    case kAnswer:
      return hmlfc_checker_answer(id, n[1], (int)n[2], (int)n[3], a->vector);
    case kStage:
      return hmlfc_checker_stage(id, n[1], (int)n[2], (int)n[3], (int)n[4], (int)n[5], (int)n[6],
                                 (int)n[7], (int)n[8], (int)n[9], a->vector);
    case kReset:
      hmlfc_checker_reset(id, n[1]);
      return 0;
    case kUnknown:
      return hmlfc_checker_unknown(id, n[1], a->strings[0]);
    case kEnd:
      return hmlfc_checker_end(id, n[1], (int)n[2]);
    default:
      result = hmlfc_checker_expected(id, (int)n[1], (int)n[2], (int)n[3], (int)n[4], (int)n[5],
                                      (int)n[6], a->vector);
      write_vector(a->output, a->vector);
      return result;
  }
}

static int is_task(int which) { return which == kPrint || which == kReset; }

static PLI_INT32 on_call(PLI_BYTE8* data) {
  const int which = (int)((const struct function*)data - kFunctions);
  vpiHandle call = vpi_handle(vpiSysTfCall, NULL);
  struct arguments* a = calloc(1, sizeof(struct arguments));
  s_vpi_value value;
  if (a == NULL || !read_arguments(call, kFunctions[which].arguments, a)) {
    vpi_printf("%s: wrong arguments\n", kFunctions[which].name);
    vpi_control(vpiFinish, 1);
  } else {
    value.format = vpiIntVal;
    value.value.integer = call_function(which, a);
    if (!is_task(which)) vpi_put_value(call, &value, NULL, vpiNoDelay);
  }
  if (a != NULL) {
    free(a->strings[0]);
    free(a->strings[1]);
  }
  free(a);
  return 0;
}

static void register_functions(void) {
  for (int i = 0; i <= kExpected; ++i) {
    s_vpi_systf_data data = {0};
    data.type = is_task(i) ? vpiSysTask : vpiSysFunc;
    data.sysfunctype = vpiIntFunc;
    data.tfname = (PLI_BYTE8*)kFunctions[i].name;
    data.calltf = on_call;
    data.user_data = (PLI_BYTE8*)&kFunctions[i];
    vpi_register_systf(&data);
  }
}

void (*vlog_startup_routines[])(void) = {register_functions, 0};
