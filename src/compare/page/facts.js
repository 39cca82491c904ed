// The head of the page: what was compared, where, and what did best.
'use strict';

function describeLight(light) {
  const at = () => `at ${format.vector(light.position)}`;
  if (light.kind === 'point') return `point light ${at()}`;
  const to = light.direction_to_light;
  if (light.kind === 'spot') return `spot ${at()}, half angle ${format.significant(light.outer_angle_degrees, 3)}°`;
  const degrees = (radians) => `${format.significant(radians * 180 / Math.PI, 3)}°`;
  const azimuth = Math.atan2(to[2], to[0]);
  return `sun, azimuth ${degrees(azimuth < -1e-9 ? azimuth + 2 * Math.PI : azimuth)}, `
      + `elevation ${degrees(Math.asin(Math.max(-1, Math.min(1, to[1]))))}`;
}

function describeCamera(camera) {
  return `eye ${format.vector(camera.eye)}, target ${format.vector(camera.target)}, `
      + `${format.significant(camera.fov_degrees, 3)}° vertical field`;
}

function describePath(path) {
  const seconds = (time) => format.significant(time, 3);
  const light = path.light_moves ? ', the light moves' : '';
  return `${format.count(path.frames)} frames from ${seconds(path.first_time)} to ${seconds(path.last_time)} s${light}; `
      + `figures are over all of them, pictures show number ${format.count(path.pictured + 1)}`;
}

function showFacts(report) {
  const deviceKinds = {cpu: 'software', discrete: 'discrete GPU', integrated: 'integrated GPU', virtual: 'virtual GPU'};
  byId('scene-name').textContent = report.scene.name || 'Unnamed scene';
  const facts = [
    ['Scene', `${format.count(report.scene.triangles)} triangles`,
      `${format.count(report.scene.instances)} instance${report.scene.instances === 1 ? '' : 's'}`],
    ['Camera', report.camera.name, describeCamera(report.camera)],
    ['Light', report.light.name, describeLight(report.light)],
    report.path && ['Path', report.path.name || 'still camera', describePath(report.path)],
    ['Device', report.device.name, deviceKinds[report.device.type] || report.device.type],
    ['Picture', `${report.image.width} × ${report.image.height}`,
      `camera pass ${format.milliseconds(report.camera_pass.milliseconds)} ms`],
    ['Truth', `${format.share(report.reference.lit_fraction)} lit`,
      `traced in ${format.significant(report.reference.milliseconds, 3)} ms`],
  ];
  for (const [term, main, rest] of facts.filter(Boolean)) {
    const lines = [main, rest].filter(Boolean);
    byId('facts').append(element('div', {}, element('dt', {}, term),
        element('dd', {}, ...lines.map((line, i) => element(i === 0 ? 'strong' : 'span', {}, line)))));
  }
}

function showHighlights(results) {
  const field = contestants(results);
  if (field.length < 2) return;
  const least = (figure) => field.reduce((best, result) => figure(result) < figure(best) ? result : best);
  const cards = [
    ['Fewest wrong pixels', least((r) => r.error.fraction), (r) => `${format.share(r.error.fraction)} wrong`],
    ['Fastest', least((r) => r.milliseconds.median), (r) => `${format.milliseconds(r.milliseconds.median)} ms`],
    ['Least memory', least((r) => r.memory_bytes), (r) => format.bytes(r.memory_bytes)],
  ];
  for (const [title, result, figure] of cards) {
    byId('highlights').append(element('div', {class: 'card'}, element('p', {class: 'card-title'}, title),
        element('p', {class: 'card-name'}, breakable(result.technique)), element('p', {class: 'card-figure'}, figure(result))));
  }
  byId('highlights').hidden = false;
}

function showNotes(notes) {
  byId('notes').append(...notes.map((note) => element('li', {}, note)));
  byId('notes-section').hidden = notes.length === 0;
}
