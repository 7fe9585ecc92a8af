/* cmd_import.c - bakeslab import: light that was measured, or simulated elsewhere, as a slab. */
#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/files.h"
#include "base/numbers.h"
#include "base/output.h"
#include "cmd/slab_options.h"
#include "file/slab_file.h"
#include "import/import.h"

/* The four options that make a page of rays. */
enum { CENTER, U, V, NORMAL, PAGE_OPTIONS };

struct arguments {
  const char **files; /* grows; owned */
  int file_count;
  const char *output;
  int given[PAGE_OPTIONS]; /* how often */
  int unit;                /* of metres[] */
  const char *views;
  enum slab_precision precision;
  struct import_wish wish;
};

#define ARGUMENT(member) offsetof(struct arguments, member)
#define KEY(member) VALUE_KEY(struct arguments, member)

static const struct argp_option options[] = {
    {"output", 'o', "SLAB", 0,
     "The slab to write: .tif (LogLuv unless --precision is given) or .exr", 1},
    {"precision", KEY(precision), CLI_PRECISIONS, 0,
     "Number format of the samples: logluv is the default for TIFF, but float where samples are "
     "negative; float for EXR",
     1},
    {"uv", KEY(wish.uv), "NxM", 0, "Positions on each page", 2},
    {"st", KEY(wish.st), "NxM", 0, "Directions of each position", 2},
    {"tolerance", KEY(wish.tolerance), "T", 0,
     "Photometric files: choose windows and the number of samples so that candela err by at most T "
     "of the largest (default 0.005; round bodies: 0.05). Ray files: the fewest, up to 16x16 x "
     "64x64, for which the error of irradiance is at "
     "most T (relative RMS) at 4 apertures and beyond; --uv and --st, where given, stay",
     2},
    {"name", 'n', "NAME", 0, "The lamp's name (default: that of the first file)", 2},
    {"lumens", KEY(wish.lumens), "X", 0,
     "Photometric and ray files: rescale the light to a flux of X lm", 3},
    {"kelvin", KEY(wish.kelvin), "K", 0,
     "Photometric files: the colour of a black body of K kelvin (default: white)", 3},
    {"turn", KEY(wish.turn), "90|180|270", 0,
     "Photometric files: turn the distribution about the vertical, from C0 towards C90, where a "
     "maker laid it across the opening",
     3},
    {"center", KEY(given[CENTER]), "X,Y,Z", 0,
     "Ray files, pictures: centre of a page. Give it, --u, --v and --normal once for each page. "
     "Default, of rays: "
     "the best rectangle",
     4},
    {"u", KEY(given[U]), "X,Y,Z", 0, "Ray files, pictures: edge of a page", 4},
    {"v", KEY(given[V]), "X,Y,Z", 0, "Ray files, pictures: its other edge, at a right angle", 4},
    {"normal", KEY(given[NORMAL]), "X,Y,Z", 0, "Ray files, pictures: where the page's light goes",
     4},
    {"box", KEY(wish.box), NULL, 0,
     "Ray files: the pages are those faces of the box around the rays' origins through which "
     "light leaves",
     4},
    {"unit", KEY(unit), "m|mm|cm|in|ft", 0,
     "Unit of a ray text's lengths, of poses, and of pages given here (default: m); the slab is in "
     "metres",
     4},
    {"views", KEY(views), "PATTERN", 0,
     "Pictures taken from a grid of positions, in place of FILE: %u and %v in the file's name are "
     "the position, from 0, as in 'view_%02u_%02v.exr'. Pixels are samples: columns run with s, "
     "rows downwards with t",
     5},
    {"window", KEY(wish.window), "S0,S1,T0,T1", 0,
     "Pictures: window of the directions, slopes as seen from --center (default, with poses: where "
     "cameras stand)",
     5},
    {"distance", KEY(wish.distance), "D", 0, "Pictures: of the st plane (default: infinity)", 5},
    {"exposure", KEY(wish.exposure), "F", 0, "Pictures: multiply their values by F", 5},
    {"vignetting", KEY(wish.vignetting), "K1,K2,K3", 0,
     "Pictures with poses: divide their values by 1 + K1 r^2 + K2 r^4 + K3 r^6, with r = 1 in the "
     "corners",
     5},
    {0}};

static const char doc[] =
    "Makes a light slab from light that was measured, or simulated elsewhere. The kind of the "
    "files is found from their content: IES LM-63, EULUMDAT; TM-25, Zemax binary source files, "
    "rays as text; pictures of a lamp with the places of their cameras (transforms.json). --views "
    "takes an array of pictures. A FILE - is standard input."
    "\v"
    "Photometric files (IES LM-63 of 1986 to 2019, EULUMDAT) give a slab in metres, in cd/m2. "
    "Gamma 0 is -y, C0 is +x, C90 is +z; of type B, H = V = 0 is -y; of type A it is +x, and V = "
    "90 is +y, and an opening that the file lays flat faces +x. In IES, too, commas may be decimal "
    "points: where numbers with commas between them do not add up.\n"
    "\n"
    "Ray files give a slab in metres, in W/(sr m2) where their rays carry watts, in cd/m2 where "
    "they carry lumens: TM-25 (.tm25ray), Zemax binary source files (.dat, .sdf), and text, a "
    "ray `x y z dx dy dz flux` a line, in watts, with comments from # on. Rays are carried "
    "along their lines to the pages: those given, the faces of a box, or the best rectangle. "
    "Those that reach none are told, with their flux. Several files are one lamp. Axes stay "
    "those of the file. TM-25 and Zemax are right-handed, so that such a lamp becomes its "
    "mirror image: where that shows, mirror the light where you place it (scale <1, 1, -1>).\n"
    "\n"
    "Pictures are linear: OpenEXR, Radiance's HDR, PFM, floating-point TIFF. The lamp's opening is "
    "given by --center, --u, --v and --normal. Pictures with poses are those of a transforms.json "
    "as Instant-NGP and Nerfstudio have it: pinhole cameras, pictures without distortion. Its "
    "frame is right-handed with z up: its point (x, y, z) is the lamp's (x, z, y). Positions are "
    "as many as pixels lie across the page, 16 to 32 a side, and directions as many as the "
    "pictures support, unless --uv and --st say otherwise; what no picture shows is "
    "filled in, and told. Views are the pictures of cameras on the aperture, in the middle of "
    "each of its cells, whose film is the window of directions, as `bakeslab bake --camera "
    "perspective` takes them. Radiance is in the pictures' unit, \"relative\".\n"
    "\n"
    "Examples:\n"
    "  bakeslab import downlight.ies -o downlight.tif\n"
    "  bakeslab import trough.ldt -o trough.tif --turn 90 --kelvin 4000\n"
    "  bakeslab import led.tm25ray -o led.tif\n"
    "  bakeslab import led.txt -o led.tif --unit mm --center 0,0,2 --u 3,0,0 \\\n"
    "    --v 0,3,0 --normal 0,0,1\n"
    "  bakeslab import transforms.json -o seen.tif --center 0,0,0 --u 0.2,0,0 \\\n"
    "    --v 0,0,0.2 --normal 0,-1,0\n"
    "  bakeslab import --views 'view_%02u_%02v.exr' -o views.tif --center 0,0,0 \\\n"
    "    --u 0.2,0,0 --v 0,0,0.2 --normal 0,-1,0 --window=-1,1,-1,1";

static const struct value values[] = {
    {'o', VALUE_TEXT, ARGUMENT(output), 0, 0},
    {KEY(precision), VALUE_WORD, ARGUMENT(precision), SLAB_PRECISION_LOGLUV, 0},
    {KEY(wish.uv), VALUE_SIZE, ARGUMENT(wish.uv), 0, 0},
    {KEY(wish.st), VALUE_SIZE, ARGUMENT(wish.st), 0, 0},
    {KEY(wish.tolerance), VALUE_POSITIVE, ARGUMENT(wish.tolerance), 0, 0},
    {'n', VALUE_TEXT, ARGUMENT(wish.name), 0, 0},
    {KEY(wish.lumens), VALUE_POSITIVE, ARGUMENT(wish.lumens), 0, 0},
    {KEY(wish.kelvin), VALUE_REAL, ARGUMENT(wish.kelvin), 1000, 40000},
    {KEY(wish.turn), VALUE_WORD, ARGUMENT(wish.turn), 1, 0},
    {KEY(wish.box), VALUE_FLAG, ARGUMENT(wish.box), 0, 0},
    {KEY(unit), VALUE_WORD, ARGUMENT(unit), 0, 0},
    {KEY(views), VALUE_TEXT, ARGUMENT(views), 0, 0},
    {KEY(wish.distance), VALUE_POSITIVE, ARGUMENT(wish.distance), 0, 0},
    {KEY(wish.exposure), VALUE_POSITIVE, ARGUMENT(wish.exposure), 0, 0},
    {0}};

static void add_file(struct arguments *arguments, const char *file) {
  size_t count = (size_t)arguments->file_count + 1;
  const char **files = realloc(arguments->files, count * sizeof *files);
  if (!files) cli_out_of_memory();
  arguments->files = files;
  files[arguments->file_count++] = file;
}

/* A vector of the next page that has none yet. */
static void add_vector(struct argp_state *state, struct arguments *arguments, int option,
                       const char *text) {
  static const char *const names[PAGE_OPTIONS] = {"center", "u", "v", "normal"};
  double vector[3];
  if (!numbers_real(text, 3, vector))
    argp_error(state, "--%s %s: must be three numbers, as in 0,0.5,0", names[option], text);
  int page = arguments->given[option]++;
  if (page >= IMPORT_APERTURES) argp_error(state, "more than %d pages", IMPORT_APERTURES);
  struct import_aperture *aperture = &arguments->wish.apertures[page];
  double *vectors[PAGE_OPTIONS] = {aperture->center, aperture->u, aperture->v, aperture->normal};
  memcpy(vectors[option], vector, sizeof vector);
}

static void check_arguments(struct argp_state *state, struct arguments *arguments) {
  const int *given = arguments->given;
  if (!arguments->output) argp_error(state, "no output given: -o SLAB");
  if (arguments->views) {
    if (arguments->file_count > 0) argp_error(state, "--views and a file: give one of them");
    add_file(arguments, arguments->views);
    arguments->wish.views = true;
  }
  if (arguments->file_count == 0) argp_error(state, "no file given");
  for (int option = 0; option < PAGE_OPTIONS; ++option)
    if (given[option] != given[CENTER])
      argp_error(state, "give each of --center, --u, --v and --normal once for each page");
  if (given[CENTER] > 0 && arguments->wish.box)
    argp_error(state, "--box and --center: give one of them");
}

static error_t parse(int key, char *text, struct argp_state *state) {
  struct arguments *arguments = state->input;
  double *window = arguments->wish.window;
  switch (key) {
  case ARGP_KEY_ARG:
    add_file(arguments, text);
    return 0;
  case ARGP_KEY_SUCCESS:
    check_arguments(state, arguments);
    return 0;
  case KEY(wish.window):
    if (!numbers_real(text, 4, window) || !(window[0] < window[1] && window[2] < window[3]))
      argp_error(state, "--window %s: must be four slopes, as in -1,1,-1,1", text);
    return 0;
  case KEY(wish.vignetting):
    if (!numbers_real(text, 3, arguments->wish.vignetting))
      argp_error(state, "--vignetting %s: must be three numbers, as in -0.4,0.1,0", text);
    return 0;
  case KEY(given[CENTER]):
    add_vector(state, arguments, CENTER, text);
    return 0;
  case KEY(given[U]):
    add_vector(state, arguments, U, text);
    return 0;
  case KEY(given[V]):
    add_vector(state, arguments, V, text);
    return 0;
  case KEY(given[NORMAL]):
    add_vector(state, arguments, NORMAL, text);
    return 0;
  default:
    return values_take(values, options, key, text, arguments, state);
  }
}

/* LogLuv cannot hold samples that are negative: where nobody asked for it, they stay as they are.
 */
static enum slab_precision precision_for(const struct import_light *light,
                                         enum slab_precision precision) {
  for (int n = 0; n < light->count && precision == SLAB_PRECISION_DEFAULT; ++n)
    if (slab_negative(&light->slabs[n]) < 3 * slab_sample_count(&light->slabs[n]))
      return SLAB_PRECISION_FLOAT;
  return precision;
}

/* Standard input is read several times, as files are: it becomes one, and is called by its name. */
static enum result take_stdin(struct arguments *arguments, struct error *error) {
  bool taken = false;
  for (int k = 0; k < arguments->file_count && !arguments->wish.views; ++k) {
    if (strcmp(arguments->files[k], "-") != 0) continue;
    if (taken) return result_fail(error, RESULT_BAD, "-: standard input can be read only once");
    int fd = files_spool_stdin();
    if (fd < 0 || dup2(fd, STDIN_FILENO) < 0)
      return result_fail(error, RESULT_IO, "stdin: cannot be read: %s", strerror(errno));
    close(fd);
    arguments->files[k] = "/dev/stdin";
    taken = true;
  }
  return RESULT_OK;
}

/* Of the units of length, in the order of --unit's words. */
static const double metres[] = {1, 0.001, 0.01, 0.0254, 0.3048};

static enum result run(void *input, struct error *error) {
  struct arguments *arguments = input;
  struct warnings notes = {0}; /* told in the end, so that a refusal is one line */
  struct import_wish *wish = &arguments->wish;
  struct import_light light = {0};
  wish->files = arguments->files;
  wish->file_count = arguments->file_count;
  wish->notes = &notes;
  wish->turn *= 90;
  wish->aperture_count = arguments->given[CENTER];
  wish->metres = metres[arguments->unit];
  enum result result = output_check(&arguments->output, 1, wish->files, wish->file_count, error);
  if (result == RESULT_OK)
    result = slab_file_check_target(arguments->output, arguments->precision, error);
  if (result == RESULT_OK) result = take_stdin(arguments, error);
  if (result == RESULT_OK) result = import_files(wish, cli_command_line(), &light, error);
  if (result == RESULT_OK)
    result = slab_file_write(arguments->output, light.slabs, light.count,
                             precision_for(&light, arguments->precision), error);
  for (int k = 0; k < warnings_kept(&notes) && result == RESULT_OK; ++k)
    cli_note("%s: note: %s", wish->files[0], notes.lines[k]);
  import_free(&light);
  return result;
}

int cmd_import(int argc, char **argv) {
  static const struct argp argp = {options, parse, "FILE... -o SLAB", doc, cli_options, NULL, NULL};
  struct arguments arguments = {0};
  int status = cli_run(&argp, argc, argv, run, &arguments);
  free(arguments.files);
  return status;
}
