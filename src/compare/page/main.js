'use strict';

{
  const {report, pictures: pictureData, changes} = JSON.parse(byId('data').textContent);
  const pictures = new Pictures(pictureData, report.image);
  showFacts(report);
  showHighlights(report.results);
  showNotes(report.notes);
  showChanges(changes, report);

  let viewer = null;
  const viewable = (side) => pictures.hasAny(side);
  if (['truth', ...report.results.keys()].some(viewable)) {
    byId('viewer-section').hidden = false;
    viewer = new Viewer(report, pictures);
  }
  if (report.results.length > 0) {
    new ResultTable(report.results, viewable, (index) => viewer.show(index));
  } else {
    byId('table-lead').textContent = 'No technique was run.';
    byId('table-scroll').hidden = true;
  }
  new ScatterChart(report.results, (result) => {
    const index = report.results.indexOf(result);
    if (viewable(index)) viewer.show(index);
  });
}
