// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// The manual page, and what shells complete, from the table of the options.

#include "../include/flatten_mesh/messages.h"
#include "../include/flatten_mesh/option_table.h"

#include <CGAL/Conformal_equivalence/version.h>

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <sstream>
#include <string>
#include <vector>

namespace flattening {

namespace {

std::vector<std::string> split(const std::string& text, char divider)
{
  std::vector<std::string> parts(1);
  for(char c : text)
    if(c == divider)
      parts.emplace_back();
    else
      parts.back() += c;
  return parts;
}

// What may follow an option on the command line.
struct Completions
{
  std::vector<std::string> words;
  bool files = false, folders = false;
};

// The words of `never|angles=FILE|auto[=N]|FILE` are `never`, `angles=` and `auto`; the last one stands for a file.
Completions completions(const std::string& value)
{
  Completions result;
  for(const std::string& alternative : split(value, '|'))
    if(alternative == "FILE")
      result.files = true;
    else if(alternative == "FOLDER")
      result.folders = true;
    else
    {
      const std::string word = alternative.substr(0, alternative.find('['));
      const std::size_t end = word.find('=');
      if(! word.empty() && std::islower(static_cast<unsigned char>(word[0])))
        result.words.push_back(word.substr(0, end == std::string::npos ? end : end + 1));
    }
  return result;
}

std::string joined(const std::vector<std::string>& words, const char* divider = " ")
{
  std::string list;
  for(const std::string& word : words)
    list += (list.empty() ? "" : divider) + word;
  return list;
}

// Whether the value may be left out, as that of `--quantize`.
bool is_optional(const Option_entry& option) { return ! option.value.empty() && option.value[0] == '['; }

// ---- The manual page

// Roff takes backslashes, and dots and quotes at the beginning of a line, for commands; a dash is a hyphen there unless it is escaped.
std::string roff(const std::string& text)
{
  std::string escaped = text.empty() || (text[0] != '.' && text[0] != '\'') ? "" : "\\&";
  for(char c : text)
    escaped += c == '\\' ? std::string("\\e") : c == '-' ? std::string("\\-") : std::string(1, c);
  return escaped;
}

void write_man_lines(std::ostream& out, const std::string& text, const char* between)
{
  std::istringstream lines(text);
  bool is_first = true;
  for(std::string line; std::getline(lines, line); is_first = false)
    out << (is_first ? "" : between) << roff(line) << '\n';
}

std::string man_page()
{
  std::ostringstream out;
  out << ".TH FLATTEN_MESH 1 \"\" \"Conformal_equivalence " << CGAL_CONFORMAL_EQUIVALENCE_VERSION << "\" \"User Commands\"\n"
      << ".SH NAME\nflatten_mesh \\- flatten triangle meshes by discrete conformal maps\n"
      << ".SH SYNOPSIS\n" << roff(synopsis) << "\n.SH DESCRIPTION\n";
  write_man_lines(out, introduction, "");
  out << ".SH EXIT STATUS\n";
  write_man_lines(out, std::string(exit_status).substr(std::string(exit_status).find(':') + 2), "");
  out << ".SH OPTIONS\n";
  for(const Option_entry& option : option_table())
  {
    out << ".TP\n\\fB" << (option.letter.empty() ? "" : roff("-" + option.letter) + "\\fR, \\fB") << roff("--" + option.name) << "\\fR"
        << (option.value.empty() ? "" : " \\fI" + roff(option.value) + "\\fR")
        << (option.if_absent.empty() ? "" : " (" + roff(option.if_absent) + ")") << '\n';
    write_man_lines(out, option.description, ".br\n");
  }
  out << ".SH EXAMPLES\n"
         ".TP\nflatten_mesh head.off \\-o flat.obj \\-\\-svg flat.svg\nthe mesh with texture coordinates, and a picture of its layout\n"
         ".TP\nflatten_mesh *.ply \\-o 'out/%.obj' \\-\\-report out/all.json\neach mesh by itself, and one report about all\n"
         ".TP\nflatten_mesh \\- \\-\\-format ply \\-o \\- < head.ply > flat.obj\nin a pipe\n"
         ".TP\nflatten_mesh ball.off \\-\\-target sphere \\-o sphere.obj\nto the unit sphere\n"
         ".TP\nflatten_mesh bear.off \\-\\-cones auto=8 \\-\\-seamless \\-o bear.obj\na layout that fits a texture of tiles without a visible seam\n";
  return out.str();
}

// ---- Shells

std::string bash_completion()
{
  std::ostringstream out;
  std::vector<std::string> names;
  out << "# Completes the options of flatten_mesh in bash.\n"
         "_flatten_mesh()\n{\n"
         "  local word=\"${COMP_WORDS[COMP_CWORD]}\" before=\"${COMP_WORDS[COMP_CWORD-1]}\" IFS=$'\\n'\n"
         "  COMPREPLY=()\n"
         "  if [ \"$word\" = = ]; then word=; fi # a word of its own for bash, as in --target=sphere\n"
         "  if [ \"$before\" = = ] && [ \"$COMP_CWORD\" -gt 2 ]; then before=\"${COMP_WORDS[COMP_CWORD-2]}\"; fi\n"
         "  case \"$before\" in\n";
  for(const Option_entry& option : option_table())
  {
    names.push_back("--" + option.name);
    if(option.value.empty() || is_optional(option))
      continue;
    const Completions c = completions(option.value);
    const std::string files = c.files ? " -f" : c.folders ? " -d" : "", words = c.words.empty() ? "" : " -W $'" + joined(c.words, "\\n") + "'";
    out << "    --" << option.name << (option.letter.empty() ? "" : "|-" + option.letter) << ")\n";
    if(! words.empty() || ! files.empty())
      out << "      COMPREPLY=($(compgen" << files << words << " -- \"$word\"))\n";
    out << "      return ;;\n";
  }
  out << "  esac\n"
         "  if [[ \"$word\" == -* ]]; then\n"
         "    COMPREPLY=($(compgen -W $'" << joined(names, "\\n") << "' -- \"$word\"))\n"
         "  else\n"
         "    COMPREPLY=($(compgen -f -- \"$word\"))\n"
         "  fi\n"
         "}\n"
         "complete -o filenames -F _flatten_mesh flatten_mesh\n";
  return out.str();
}

// The first line of a description, without what shells take for quotes and brackets.
std::string short_description(const Option_entry& option)
{
  std::string line = option.description.substr(0, option.description.find('\n'));
  for(const char* end : {": ", "; ", ". "})
    line = line.substr(0, line.find(end));
  line.erase(std::remove_if(line.begin(), line.end(), [](char c) { return c == '\'' || c == '[' || c == ']' || c == '\\' || c == ':'; }), line.end());
  return line;
}

std::string zsh_completion()
{
  std::ostringstream out;
  out << "#compdef flatten_mesh\n"
         "# Completes the options of flatten_mesh in zsh.\n"
         "_arguments \\\n";
  for(const Option_entry& option : option_table())
  {
    const std::string name = "--" + option.name, description = "[" + short_description(option) + "]";
    std::string value;
    if(! option.value.empty() && ! is_optional(option))
    {
      const Completions c = completions(option.value);
      std::vector<std::string> commands;
      if(! c.words.empty())
        commands.push_back("compadd -- " + joined(c.words));
      if(c.files || c.folders)
        commands.push_back(c.files ? "_files" : "_files -/");
      value = ":value:" + (commands.empty() ? std::string(" ") : "{ " + joined(commands, "; ") + " }");
    }
    const std::string times = option.is_repeatable ? "*" : "", others = option.is_repeatable ? "*" : "(-" + option.letter + ' ' + name + ")";
    if(option.letter.empty())
      out << "  '" << times << name << description << value << "' \\\n";
    else
      out << "  '" << others << "'{-" << option.letter << ',' << name << "}'" << description << value << "' \\\n";
  }
  out << "  '*:input:_files'\n";
  return out.str();
}

std::string fish_completion()
{
  std::ostringstream out;
  out << "# Completes the options of flatten_mesh in fish.\n";
  for(const Option_entry& option : option_table())
  {
    out << "complete -c flatten_mesh -l " << option.name;
    if(! option.letter.empty())
      out << " -s " << option.letter;
    if(! option.value.empty() && ! is_optional(option))
    {
      const Completions c = completions(option.value);
      out << (c.files || c.folders ? " -r" : " -x");
      const std::string words = joined(c.words) + (c.folders ? " (__fish_complete_directories)" : "");
      if(! words.empty())
        out << " -a '" << words << '\'';
    }
    out << " -d '" << short_description(option) << "'\n";
  }
  return out.str();
}

} // namespace

const char* const synopsis =
  "flatten_mesh INPUT... [-o OUT.obj] [--svg OUT.svg] [--html OUT.html] [--report OUT.json] [options]";

const char* const introduction =
  "Flattens triangle meshes (OFF, OBJ, PLY or STL) of any topology by an exact discrete conformal map:\n"
  "the layout has the length cross ratios of the mesh. What is no topological disk, or has cones, is\n"
  "cut open. Closed surfaces without handles are also mapped to the sphere, disks to the unit disk.\n"
  "Faces with more than three sides are divided into triangles to compute, and written as they were.\n"
  "Vertices and faces are counted from 0. The file '-' is the standard input or output.\n"
  "In the names of outputs, % stands for the name of INPUT without folder and extension, and %% for %:\n"
  "flatten_mesh *.off -o 'out/%.obj' flattens each by itself, and goes on if one of them fails.\n";

const char* const exit_status =
  "Exit status: 0 done, no triangle flipped (on sphere and disk: but for those that rounding has cost,\n"
  "which are counted); 1 an input failed, and nothing is written of it; 2 wrong usage; 3 interrupted\n"
  "(Ctrl-C) while cones were placed by --cones auto: the best that were found by then are written.\n";

std::string printed_text(const std::string& what)
{
  if(what == "man")
    return man_page();
  if(what == "bash")
    return bash_completion();
  if(what == "zsh")
    return zsh_completion();
  if(what == "fish")
    return fish_completion();
  throw Usage_error("unknown value '" + what + "' of --print");
}

} // namespace flattening
