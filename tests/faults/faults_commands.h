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
  const char *outputs; /* files that it writes */
  int fails_with;      /* exit status; 0: 1 */
  bool goes_on;        /* keeps finished work where it fails */
  int cost;            /* one in so many faults is tried; 0: all */
  bool together;       /* the outputs are of use only with each other */
};

static const struct faults_command faults_commands[] = {
    {.name = "info", .line = "bakeslab info ../in/little.tif", .outputs = ""},
    {.name = "info-json", .line = "bakeslab info --json ../in/little.tif", .outputs = ""},
    {.name = "info-stdin", .line = "bakeslab info -", .in = "../in/little.tif", .outputs = ""},
    {.name = "check", .line = "bakeslab check --error ../in/little.tif", .outputs = "", .cost = 4},
    {.name = "lookup",
     .line = "bakeslab lookup ../in/little.tif",
     .in = "../in/rays",
     .outputs = ""},
    {.name = "diff",
     .line = "bakeslab diff ../in/little.tif ../in/little.tif",
     .outputs = "",
     .fails_with = 2},
    {.name = "convert-logluv",
     .line = "bakeslab convert ../in/little.tif -o x.tif",
     .outputs = "x.tif"},
    {.name = "convert-exr",
     .line = "bakeslab convert ../in/little.tif -o x.exr --uv 3 --precision half",
     .outputs = "x.exr"},
    {.name = "convert-stdout", .line = "bakeslab convert ../in/little.tif -o -", .outputs = ""},
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
    {.name = "bake",
     .line = "bakeslab bake -q ../in/fake.pov -o x.tif --povray ../fake_povray --uv 3 --st 4 "
             "--rays 8 --jobs 2 --depend x.d",
     .outputs = "x.tif x.d",
     .goes_on = true,
     .cost = 2},
    {.name = "bake-probe",
     .line = "bakeslab bake -q ../in/fake.pov -o x.exr --povray ../fake_povray --uv 2 --st 4 "
             "--rays 4 --effects probe --window auto --jobs 1",
     .outputs = "x.exr",
     .goes_on = true,
     .cost = 16},
    {.name = "irradiance",
     .line = "renderslab irradiance --light ../in/little.tif --mesh ../in/square.obj --threads 2",
     .in = "../in/receivers",
     .outputs = ""},
    {.name = "image",
     .line = "renderslab image -q ../in/square.obj --light ../in/little.tif --camera @../in/camera "
             "--size 8x6 --threads 2 -o x.exr --preview x.png",
     .outputs = "x.exr x.png"},
    {.name = "pov",
     .line =
         "renderslab pov ../in/square.obj --light ../in/little.tif --camera @../in/camera -o x.pov",
     .outputs = "x.pov"},
};
enum { faults_command_count = sizeof faults_commands / sizeof *faults_commands };

#endif
