/* include_text.c - see include_text.h. */
#include "include/text/include_text.h"

#include <inttypes.h>
#include <string.h>

#include "base/sdl.h"

void include_named(const char *template, const char *name, FILE *out) {
  for (; *template; ++template) {
    if (*template == '@')
      fputs(name, out);
    else
      putc(*template, out);
  }
}

static void print_files(const struct include_text *text, FILE *out) {
  fputs("// Persistence of Vision Ray Tracer Scene Include File\n// File:    ", out);
  sdl_comment(text->file, out);
  if (text->image) {
    fputs(", with its image ", out);
    sdl_comment(text->image, out);
    fputs(" beside it", out);
  }
  putc('\n', out);
}

void include_head(const struct include_text *text, const char *description, const char *options,
                  FILE *out) {
  print_files(text, out);
  fprintf(out,
          "// For:     POV-Ray 3.7 or later; nothing else is needed to render\n"
          "// Desc:    canned light source %s: a lamp that was simulated once, as the\n"
          "//          light that leaves its aperture. %s"
          "// Licence: CC0 1.0, public domain: use it as you like\n"
          "// Made by: ",
          text->name, description);
  sdl_comment(text->command, out);
  if (text->chosen) {
    fputs("\n// Chosen:  ", out);
    sdl_comment(text->chosen, out);
  }
  fputs("\n//\n// Usage:   global_settings { assumed_gamma 1.0 }\n//          #include \"", out);
  sdl_comment(text->file, out);
  include_named("\"\n"
                "//          object { @_Canned(1, 1) rotate x*30 translate <0, 2, 0> }\n"
                "//\n"
                "// @_Canned(Scale, Gain)\n"
                "//   Scale: size of the lamp at the same radiance. Rotate, translate and mirror\n"
                "//   the object at will, but never `scale' it: POV-Ray does not scale lights.\n"
                "//   Gain: multiplies the radiance; a number or a colour.\n",
                text->name, out);
  include_named(text->housing
                    ? "// @_Canned_Case()\n"
                      "//   The visible lamp, at Scale 1, for pictures in which it is seen.\n"
                    : "// @_Canned_Case() is not declared: the lamp came without a housing",
                text->name, out);
  if (!text->housing) fputs(text->housing_left_out ? " that could be used.\n" : ".\n", out);
  if (!*options) return;
  fputs("//\n// Declare before the #include, where the default does not suit:\n", out);
  include_named(options, text->name, out);
}

void include_units(const struct slab *slab, FILE *out) {
  fprintf(out,
          "//\n"
          "// Units:   1 unit is %.6g m at Scale 1; radiance: %s. A surface of pigment P,\n"
          "//          diffuse 1, shows the radiance P*E/pi; phong and specular highlights\n"
          "//          are POV-Ray's, which have no 1/pi.\n",
          slab->metres_per_unit, slab->radiance_unit);
}

static uint64_t stamp_of(const struct include_text *text, uint64_t stamp) {
  if (!text->housing) return stamp;
  return include_hash(stamp, text->housing, strlen(text->housing));
}

void include_begin(const struct include_text *text, uint64_t stamp, FILE *out) {
  include_named("\n#ifndef(@_Canned_Inc_Temp)\n"
                "#declare @_Canned_Inc_Temp = version;\n"
                "#version 3.7;\n"
                "#ifdef(View_POV_Include_Stack)\n"
                "  #debug \"including @_Canned\\n\"\n"
                "#end\n\n",
                text->name, out);
  fprintf(out, "#declare %s_Stamp = \"%016" PRIx64 "\";  // of this lamp's data\n", text->name,
          stamp_of(text, stamp));
}

void include_end(const struct include_text *text, uint64_t stamp, FILE *out) {
  if (text->housing) {
    include_named("\n#macro @_Canned_Case()\n", text->name, out);
    fprintf(out, "%s\n#end\n", text->housing);
  }
  include_named("\n#version @_Canned_Inc_Temp;\n"
                "#else\n"
                "  #if (strcmp(@_Stamp, \"",
                text->name, out);
  fprintf(out, "%016" PRIx64, stamp_of(text, stamp));
  include_named("\") != 0)\n"
                "    #error concat(\"@_Canned: another lamp of this name is included already; \",\n"
                "      \"make one anew with `bakeslab include --name'\\n\")\n"
                "  #end\n"
                "#end\n",
                text->name, out);
}

/* Where assumed_gamma is not 1, POV-Ray changes what it reads unless told a gamma
 * that undoes it. */
void include_image(const struct include_text *text, const char *mapping,
                   const struct include_check *check, FILE *out) {
  static const char *const channels[3] = {"red", "green", "blue"};
  const char *channel = channels[check->channel];
  double value = check->rgb[check->channel];
  include_named("#ifndef(@_Sheet_File) #declare @_Sheet_File = ", text->name, out);
  sdl_string(text->image, out);
  include_named(
      "; #end\n"
      "#if (!file_exists(@_Sheet_File))\n"
      "  #error concat(\"@_Canned: no image \", @_Sheet_File, \": put it into the scene's\",\n"
      "    \" folder, or declare @_Sheet_File before the #include\\n\")\n"
      "#end\n",
      text->name, out);
  fprintf(out,
          "#local Check_ = <%.9g, %.9g, %.9g>;  // where the image holds %.10g, %.10g, %.10g\n",
          check->at[0], check->at[1], check->at[2], check->rgb[0], check->rgb[1], check->rgb[2]);
  include_named("#declare @_Sheet = pigment { image_map { exr @_Sheet_File ", text->name, out);
  fprintf(out, "%sinterpolate 2 filter all 1 } };\n", mapping);
  include_named("#local Look_ = function { pigment { @_Sheet } };\n"
                "#local Seen_ = Look_(Check_.x, Check_.y, Check_.z);\n",
                text->name, out);
  fprintf(out, "#if (Seen_.%s > 0 & Seen_.%s < 1 & abs(Seen_.%s - %.9g) > 1e-4)\n", channel,
          channel, channel, value);
  fprintf(out, "  #local Gamma_ = ln(%.9g)/ln(Seen_.%s);  // the scene's assumed_gamma: undo it\n",
          value, channel);
  include_named("  #declare @_Sheet = pigment { image_map { exr @_Sheet_File gamma Gamma_\n    ",
                text->name, out);
  fprintf(out, "%sinterpolate 2 filter all 1 } };\n", mapping);
  include_named("  #undef Look_\n"
                "  #local Look_ = function { pigment { @_Sheet } };\n"
                "  #local Seen_ = Look_(Check_.x, Check_.y, Check_.z);\n"
                "#end\n",
                text->name, out);
  fprintf(out,
          "#if (vlength(<Seen_.red, Seen_.green, Seen_.blue> - <%.10g, %.10g, %.10g>) > 4e-4)\n",
          check->rgb[0], check->rgb[1], check->rgb[2]);
  include_named(
      "  #error concat(\"@_Canned: \", @_Sheet_File, \" is not the image that was made with \",\n"
      "    \"this include; make both anew with `bakeslab include'\\n\")\n"
      "#end\n\n",
      text->name, out);
}

const double include_most_width = 1e9;

/* POV-Ray's str() and #error have room for about 127 characters, its <= and >= take 1e-10 for
 * nothing, NaN for anything; < and > do neither. */
void include_checks(const char *name, FILE *out) {
  fprintf(out, "#declare %s_Most_Width = %g;  // of a lamp in the scene\n\n", name,
          include_most_width);
  include_named(
      "// A number for messages, rounded up to five digits.\n"
      "#macro @_Text(X_)\n"
      "  #local Size_ = min(max(X_, 1e-300), 1e300);\n"
      "  #local Power_ = floor(log(Size_));\n"
      "  #local Digits_ = ceil(Size_*pow(10, 4 - Power_) - 1e-6);\n"
      "  #if (!(X_ > 0)) str(max(X_, -1e50), 0, 4)\n"
      "  #else #if (abs(Power_) > 9) concat(str(Digits_/1e4, 0, 4), \"e\", str(Power_, 0, 0))\n"
      "  #else str(Digits_/pow(10, 4 - Power_), 0, max(4 - Power_, 0)) #end #end\n"
      "#end\n"
      "\n"
      "// Stops where the lamp is too bright or too faint for POV-Ray, whose colours end near\n"
      "// 1e38, and which drops what a light gives below 1e-10. Colour_ is the brightest light's.\n"
      "#macro @_Strength(Colour_)\n"
      "  #local Most_ = max(abs(Colour_.x), abs(Colour_.y), abs(Colour_.z));\n"
      "  #if (!(Most_ < 1e37 & vlength(Colour_) > -1))\n"
      "    #error \"@_Canned: too bright for POV-Ray's light colours: use a smaller Gain\\n\"\n"
      "  #end\n"
      "  #local Reach_ = sqrt(2e4*Most_);  // in aperture widths, with the fade that lights have\n"
      "  #if (Most_ > 0 & Reach_ < 1000)\n"
      "    #local Text_ = concat(\"@_Canned: too faint beyond \", @_Text(Reach_),\n"
      "      \" apertures, where POV-Ray drops its light: use \", @_Text(pow(1000/Reach_, 2)),\n"
      "      \" times the Gain\\n\")\n"
      "    #if (Reach_ < 100) #error Text_ #else #warning Text_ #end\n"
      "  #end\n"
      "#end\n"
      "\n"
      "// Stops where the lamp, so wide in the scene, is too large: POV-Ray's objects end 1e10\n"
      "// units from the origin.\n"
      "#macro @_Fits(Width_)\n"
      "  #if (!(Width_ < 1.001*@_Most_Width))\n"
      "    #error concat(\"@_Canned: too large for POV-Ray, whose objects end at 1e10:\",\n"
      "      \" use a smaller Scale\\n\")\n"
      "  #end\n"
      "#end\n\n",
      name, out);
}

void include_canned(const char *name, FILE *out) {
  include_named(
      "#macro @_Canned(Scale, Gain)\n"
      "  // As three numbers each, whether they were given as a number or as a vector.\n"
      "  #local Scales_ = <1, 1, 1>*Scale;      #local Gains_ = <1, 1, 1>*Gain;\n"
      "  #local Size_ = Scales_.x;              #local Gain_ = <Gains_.x, Gains_.y, Gains_.z>;\n"
      "  #local Least_ = min(Size_, Scales_.y, Scales_.z);\n"
      "  #if (!(Size_ > 0 & Least_ > 0))\n"
      "    #error concat(\"@_Canned: Scale is \", @_Text(Least_), \", must be positive\\n\")\n"
      "  #end\n"
      "  #if (abs(Scales_.y/Size_ - 1) + abs(Scales_.z/Size_ - 1) > 1e-9)\n"
      "    #error concat(\"@_Canned: Scale must be one number: a lamp cannot be stretched,\",\n"
      "      \" only turned, moved and mirrored\\n\")\n"
      "  #end\n",
      name, out);
}

const uint64_t include_hash_start = 14695981039346656037u;

uint64_t include_hash(uint64_t hash, const void *bytes, size_t count) {
  const unsigned char *byte = bytes;
  for (size_t k = 0; k < count; ++k) hash = (hash ^ byte[k]) * 1099511628211u;
  return hash;
}
