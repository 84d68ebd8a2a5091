// "Save as test": a step as a shell script that holds the mesh around the probe, the probe, the command that asks, and the truth.
import { Mesh, Series, Trace } from "./data";

const quoted = (text: string) => /^[\w.,:=%/+-]+$/.test(text) ? text : "'" + text.replace(/'/g, "'\\''") + "'";
/** Names in comments: one line, whatever a file is called. */
const oneLine = (text: string) => text.replace(/[\u0000-\u001f\u007f\u2028\u2029]/g, " ");
const MISSED = 1, FALSE_CONTACT = 2, WRONG_TRIANGLE = 4, WRONG_DISTANCE = 8;  // of the charges
const JUDGED = MISSED | FALSE_CONTACT | WRONG_TRIANGLE | WRONG_DISTANCE;

/** Words as the program writes them, and nothing else that a shell would run. */
const COMMAND = /^touchmark query (?:[\w.,:=%/+@-]|'[^']*'|\\'| )+$/;

/** The script's text; null where the page does not hold the triangles around this step, or the way of a sweep, and where something was
    wrong that the script would not see: a point or a normal alone. */
export function testOf(mesh: Mesh, trace: Trace, step: number, series: Series): string | null {
  const noted = trace.notedAt.get(step), repeat = series.about.repeat;
  if (noted === undefined || !trace.near(noted).length || trace.about.query === "sweep") return null;
  if (series.charged[step] && !(series.charged[step] & JUDGED)) return null;
  const { center, radius, reach } = trace.probe(noted);
  const triangles = Array.from(trace.near(noted)).sort((a, b) => mesh.nearIds[a] - mesh.nearIds[b]);
  const answer = series.answer(noted), charged = series.charged[step], found = trace.found(step) ? 1 : 0;
  const truth = found ? `touching 1${trace.about.query === "nearest" ? `, distance ${trace.distance(step)}, triangle ${trace.triangle[step]}` : ""}` : "touching 0";
  const answered = series.found[step] === 1 ? `touching 1${answer && trace.about.query === "nearest" ? `, distance ${answer.distance}` : ""}` : "touching 0";
  const first = triangles.findIndex((one) => mesh.nearIds[one] === trace.triangle[step]);
  const ids = triangles.findIndex((one, i) => i > 0 && mesh.nearIds[one] === mesh.nearIds[triangles[i - 1]]) < 0;
  // The triangle counts where it was what was wrong, and the cut mesh can name it.
  const names = found && charged & WRONG_TRIANGLE && ids && first >= 0;
  const allowed = 1e-9 * (trace.distance(step) + radius) + 1e-15 * mesh.about.diagonal;
  // What was charged is not to pass.
  const tolerance = answer && charged & WRONG_DISTANCE ? Math.min(allowed, Math.abs(answer.distance - trace.distance(step)) / 2) : allowed;
  const distance = found && trace.about.query === "nearest" ? ` && distance_is($4, ${trace.distance(step)}, ${tolerance})` : "";
  const then = !charged || !answer ? "1" : series.found[step] !== 1 ? "$2 == 0" : trace.about.query === "nearest" ? `$2 == 1 && distance_is($4, ${answer.distance}, ${1e-12 * Math.abs(answer.distance)})` : "$2 == 1";
  const command = `query --mesh "$folder/mesh.obj" --trajectory "$folder/probe.csv" --detector ${quoted(series.name)} --query ${trace.about.query} --radius ${radius} --reach ${Number.isFinite(reach) ? reach : "inf"} --step 0`;
  const whole = COMMAND.test(repeat) ? `"$touchmark" ${repeat.replace(/^touchmark /, "")}${step}` : "";
  return `#!/bin/sh
# Step ${step} of ${oneLine(trace.name)} on ${oneLine(mesh.about.name)}, cut to the ${triangles.length} triangles nearest to the probe. Asks ${oneLine(series.name)}
# and exits with 0 where the answer is the truth, 1 where it is not, 2 where there is none.
# The truth: ${truth} of the whole mesh. The answer then: ${answered}.
touchmark=\${TOUCHMARK:-touchmark}
folder=$(mktemp -d) || exit 2
trap 'rm -r "$folder"' EXIT
cat >"$folder/mesh.obj" <<'MESH'
${objOf(mesh, triangles)}
MESH
cat >"$folder/probe.csv" <<'PROBE'
x,y,z
${center.join(",")}
PROBE
judged() { # WHICH_TRIANGLE
  awk -F, -v triangle="$1" '
    function distance_is(one, other, within) { return one - other <= within && other - one <= within }
    NR == 1 { next }
    {
      right = $2 == ${found}${distance} && (triangle == "" || $3 == triangle); as_then = ${then}; rows = 1
      print (right ? "right: " : as_then ? "wrong: " : "wrong, but not as then: ") $0
    }
    END { exit rows ? (right ? 0 : as_then ? 1 : 3) : 2 }'
}
"$touchmark" ${command} | judged ${names ? first : "''"}
status=$?
${charged && whole ? `if [ $status = 0 ] || [ $status = 3 ]; then
  echo 'The cut mesh has another answer, so that one depends on the steps before or on the rest of the mesh. On the whole mesh:'
  ${whole} | judged ${names ? trace.triangle[step] : "''"}
  status=$?
fi
` : ""}[ $status != 3 ] || exit 1
exit $status
`;
}

/** The triangles as an OBJ file, each with the id that it has in the whole mesh. */
function objOf(mesh: Mesh, triangles: number[]): string {
  const numbers = new Map<number, number>(), vertices: string[] = [], faces: string[] = [];
  for (const triangle of triangles) {
    const corners = [0, 1, 2].map((k) => {
      const vertex = mesh.nearCorners[3 * triangle + k];
      if (!numbers.has(vertex)) {
        numbers.set(vertex, numbers.size + 1);
        vertices.push("v " + [0, 1, 2].map((axis) => mesh.nearVertices[3 * vertex + axis]).join(" "));
      }
      return numbers.get(vertex);
    });
    faces.push(`# triangle ${mesh.nearIds[triangle]}\nf ${corners.join(" ")}`);
  }
  return [...vertices, ...faces].join("\n");
}

export function download(name: string, text: string): void {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(new Blob([text], { type: "text/x-shellscript" }));
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10000);
}
