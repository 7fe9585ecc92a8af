/* faults_commands.h - the commands that faults.c disturbs, each in a folder of its own beside
 * ../in, which holds little.tif and the files of tests/faults/in. */
#ifndef FAULTS_COMMANDS_H
#define FAULTS_COMMANDS_H

#include <stdbool.h>
#include <stddef.h>

struct faults_command {
  const char *name;
  const char *line;    /* words between single blanks */
  const char *in;      /* stdin, or NULL */
  const char *outputs; /* files that it writes, and folders with a slash behind, or NULL */
  int fails_with;      /* exit status; 0: 1 */
  bool goes_on;        /* keeps finished work where it fails */
  int cost;            /* one in so many faults is tried; 0: all */
  bool together;       /* the outputs are of use only with each other */
  bool children;       /* writes of the programs that it runs fail, too */
  bool timed;          /* its texts hold times: compared are what is no number */
  bool driver;         /* uses one, which takes memory for granted: only disks fail */
};

static const struct faults_command faults_commands[] = {
    {.name = "info", .line = "bakeslab info ../in/little.tif"},
    {.name = "info-json", .line = "bakeslab info --json ../in/little.tif"},
    {.name = "info-stdin", .line = "bakeslab info -", .in = "../in/little.tif"},
    {.name = "check", .line = "bakeslab check --error ../in/little.tif", .cost = 4},
    {.name = "lookup", .line = "bakeslab lookup ../in/little.tif", .in = "../in/rays"},
    {.name = "diff", .line = "bakeslab diff ../in/little.tif ../in/little.tif", .fails_with = 2},
    {.name = "convert-logluv",
     .line = "bakeslab convert ../in/little.tif -o x.tif",
     .outputs = "x.tif"},
    {.name = "convert-exr",
     .line = "bakeslab convert ../in/little.tif -o x.exr --uv 3 --precision half",
     .outputs = "x.exr"},
    {.name = "convert-sharpen",
     .line = "bakeslab convert ../in/little.tif -q -o x.tif --crop uv=0:1,0:2 --st 4 --sharpen st "
             "--positive --precision half",
     .outputs = "x.tif"},
    {.name = "projector",
     .line = "bakeslab projector ../in/four.ppm -o x.tif --aperture 1 --focus 2 --width 1 --uv 2",
     .outputs = "x.tif",
     .cost = 4,
     .children = true},
    {.name = "import-rays",
     .line = "bakeslab import ../in/led -q -o x.tif --box --uv 2 --st 4",
     .outputs = "x.tif",
     .cost = 2},
    {.name = "import-posed",
     .line = "bakeslab import ../in/poses.json -q -o x.tif --uv 2 --st 2 --center 0,0,0 --u 1,0,0 "
             "--v 0,0,1 --normal 0,-1,0 --window -1,1,-1,1",
     .outputs = "x.tif",
     .cost = 8,
     .children = true},
    {.name = "import-views",
     .line = "bakeslab import -q -o x.tif --views ../in/v%u%v.pfm --center 0,0,0 --u 1,0,0 "
             "--v 0,0,1 --normal 0,-1,0 --window -1,1,-1,1",
     .outputs = "x.tif",
     .cost = 8,
     .children = true},
    {.name = "export-radiance",
     .line = "bakeslab export ../in/little.tif -q -o x --as radiance --name lamp --force",
     .outputs = "x/",
     .cost = 4},
    {.name = "export-mitsuba",
     .line = "bakeslab export ../in/little.tif -q -o x --as mitsuba --name lamp --force",
     .outputs = "x/",
     .cost = 4},
    {.name = "export-cycles",
     .line = "bakeslab export ../in/little.tif -q -o x --as cycles --name lamp --force",
     .outputs = "x/",
     .cost = 8},
    {.name = "export-ies",
     .line = "bakeslab export ../in/little.tif -q -o x.ies",
     .outputs = "x.ies",
     .cost = 4},
    {.name = "export-rays",
     .line = "bakeslab export ../in/little.tif -q -o x.tm25ray --rays 100",
     .outputs = "x.tm25ray",
     .cost = 4},
    {.name = "convert-stdout", .line = "bakeslab convert ../in/little.tif -o -"},
    {.name = "arguments", .line = "bakeslab @../in/arguments", .outputs = "x.tif"},
    {.name = "include-sheet",
     .line = "bakeslab include ../in/little.tif --name lamp -o x.inc",
     .outputs = "x.inc x.exr",
     .cost = 4,
     .together = true},
    {.name = "include-cluster",
     .line = "bakeslab include ../in/little.tif --name lamp -m cluster -l 2 -o x.inc",
     .outputs = "x.inc",
     .cost = 40},
    {.name = "include-point",
     .line = "bakeslab include ../in/little.tif --name lamp -m point -o x.inc",
     .outputs = "x.inc x.exr",
     .cost = 4,
     .together = true},
    {.name = "include-auto",
     .line = "bakeslab include -q ../in/little.tif --name lamp -m auto --tolerance 0.3 -o x.inc",
     .outputs = "x.inc x.exr",
     .cost = 40,
     .together = true},
    {.name = "bake",
     .line = "bakeslab bake -q ../in/fake.pov -o x.tif --povray ../fake_povray --uv 3 --st 4 "
             "--rays 8 --jobs 2 --depend x.d",
     .outputs = "x.tif x.d",
     .goes_on = true,
     .cost = 2,
     .children = true},
    {.name = "bake-probe",
     .line = "bakeslab bake -q ../in/fake.pov -o x.exr --povray ../fake_povray --uv 2 --st 4 "
             "--rays 4 --effects probe --window auto --jobs 1",
     .outputs = "x.exr",
     .goes_on = true,
     .cost = 16,
     .children = true},
    {.name = "irradiance",
     .line = "renderslab irradiance --light ../in/little.tif --mesh ../in/square.obj --threads 2",
     .in = "../in/receivers"},
    {.name = "irradiance-cut",
     .line = "renderslab irradiance --light ../in/little.tif --method cut --threads 1",
     .in = "../in/receivers"},
    {.name = "image",
     .line = "renderslab image -q ../in/square.obj @../in/lit --threads 2 -o x.exr --preview x.png",
     .outputs = "x.exr x.png"},
    {.name = "image-stats",
     .line = "renderslab image -q ../in/slide.obj @../in/lit --method cut --threads 1 -o - --stats "
             "x.json",
     .outputs = "x.json",
     .cost = 8,
     .children = true,
     .timed = true},
    {.name = "image-gl",
     .line = "renderslab image -q ../in/square.obj @../in/lit --method gl -o x.exr",
     .outputs = "x.exr",
     .cost = 20,
     .driver = true},
    {.name = "tradeoff",
     .line = "renderslab tradeoff -q ../in/square.obj @../in/lit --repeats 1 --finest 0.1 "
             "--methods pi,auto -o x.tsv",
     .outputs = "x.tsv",
     .cost = 4,
     .timed = true},
    {.name = "tradeoff-plot",
     .line = "renderslab tradeoff -q ../in/square.obj @../in/lit --repeats 1 --finest 0.1 "
             "--methods pi -o x.tsv --plot x.svg",
     .outputs = "x.tsv x.svg",
     .cost = 20,
     .children = true,
     .timed = true},
    {.name = "view",
     .line = "renderslab view -q ../in/square.obj @../in/lit --size 60x40 @../in/keys",
     .outputs = "view-1.exr",
     .cost = 20,
     .driver = true},
    {.name = "pov",
     .line = "renderslab pov ../in/square.obj @../in/lit -o x.pov",
     .outputs = "x.pov"},
};
enum { faults_command_count = sizeof faults_commands / sizeof *faults_commands };

#endif
