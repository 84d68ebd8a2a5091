// "Save as test": a step as a shell script that holds the mesh around the probe, the probe, and the command that asks.
import { Mesh, Trace } from "./data";

const quoted = (text: string) => /^[\w.,:=%/+-]+$/.test(text) ? text : "'" + text.replace(/'/g, "'\\''") + "'";

/** The script's text; null where the page does not hold the triangles around this step. */
export function testOf(mesh: Mesh, trace: Trace, step: number, contestant: string, repeat: string): string | null {
  const noted = trace.notedAt.get(step);
  if (noted === undefined || !trace.near(noted).length) return null;
  const { center, radius, reach } = trace.probe(noted), numbers = new Map<number, number>(), vertices: string[] = [], faces: string[] = [];
  for (const triangle of [...trace.near(noted)].sort((a, b) => mesh.nearIds[a] - mesh.nearIds[b])) {
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
  const truth = trace.found(step) ? `distance ${trace.distance(step)}, triangle ${trace.triangle[step]} of the whole mesh` : "nothing in reach";
  const name = `step-${step}`;
  return `#!/bin/sh
# Step ${step} of ${trace.name} on ${mesh.about.name}, cut to the ${faces.length} triangles nearest to the probe.
# The truth: ${truth}. What depends on the steps before, or on the whole mesh, needs the whole:
#   ${repeat}${step}
set -e
folder=$(mktemp -d)
trap 'rm -r "$folder"' EXIT
cat >"$folder/${name}.obj" <<'MESH'
${vertices.join("\n")}
${faces.join("\n")}
MESH
cat >"$folder/${name}.csv" <<'PROBE'
x,y,z
${center.join(",")}
PROBE
\${TOUCHMARK:-touchmark} query --mesh "$folder/${name}.obj" --trajectory "$folder/${name}.csv" --detector ${quoted(contestant)} --query ${trace.about.query} --radius ${radius} --reach ${Number.isFinite(reach) ? reach : "inf"} --step 0
`;
}

export function download(name: string, text: string): void {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(new Blob([text], { type: "text/x-shellscript" }));
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10000);
}
