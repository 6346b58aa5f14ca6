// The page of a server: the map as it grows, plans as they come.
"use strict";

const live = {};

/** What the server told last: see LivePage::state(). */
let state = null;
/** The map that is shown, by its id. */
let shownMap = "";
/** Is told of each state. */
let onState = () => {};

/** Tells how the connection is, and what came last. */
const tell = text => { page.element("live").textContent = text; };

const listen = () => {
  const events = new EventSource("events");
  events.addEventListener("state", event => {
    state = JSON.parse(event.data);
    onState();
  });
  events.addEventListener("error", () => {
    tell(events.readyState === EventSource.CLOSED
      ? "the server has no place for another page: close one and load this one again"
      : "the server is away, asking again ...");
  });
};

/** Fetches what changed of the map since the one that is shown, all at first: {bricks, isWhole}. */
const fetchMap = async () => {
  const response = await fetch("map?since=" + encodeURIComponent(shownMap));
  if (!response.ok) throw new Error(await response.text());
  const {id, error, map, bricks, is_whole: isWhole} = await response.json();
  if (error) throw new Error(error);
  page.data.map = map;
  return {id, bricks, isWhole};
};

/** Shows the newest map: fetches what `put(bricks, isWhole)` puts in place. */
live.update = async put => {
  const {id, bricks, isWhole} = await fetchMap();
  await put(bricks, isWhole);
  shownMap = id;
};

/** The number of the plan whose gains are shown, as `plan` below; none while nobody asked. */
let gainsPlan = "";

/** Fetches the gains of the newest plan into the page's data: a function that gives the blocks. */
const fetchGains = async () => {
  const response = await fetch("gains");
  if (!response.ok) throw new Error(await response.text());
  const {plan, error, answer, landscape, voxel_gains, map_version, blocks} = await response.json();
  gainsPlan = `${state.map.split("-")[0]}-${plan}`;
  page.element("gains-facts").textContent = plan === 0 ? "there is no plan yet"
    : error || `of plan ${plan}, judged on map version ${map_version}`
      + (landscape ? "" : "; the landscape takes too long here: ask nbvopt view for it");
  Object.assign(page.data, {landscape, voxel_gains});
  page.showParts();
  return {answer, bytes: id => page.unpack(blocks && blocks[id])};
};

/** Shows the first map; the server knows from then on that somebody follows it. */
live.first = async put => {
  listen();
  await live.update(put);
};

const tellState = () => {
  const isBehind = state.map !== shownMap;
  tell(`live: map version ${state.map_version}${isBehind ? " (is being drawn)" : ""}, `
    + (state.plan === 0 ? "no plan yet" : `plan ${state.plan}`));
};

/** Follows the server for ever: puts what changed into the map, and shows answers as they come. */
live.follow = ({putBricks, showAnswer, showGains}) => {
  const kPause_ms = 100;
  const kGainsPause_ms = 500;
  const kPauseAfterError_ms = 5000;
  let isFetching = false;
  let plan = "";
  const keepUp = async () => {
    if (isFetching || state.map === shownMap) return;
    isFetching = true;
    let pause_ms = kPause_ms;
    try {
      await live.update(putBricks);
      tellState();
    } catch (error) {
      tell("the map cannot be shown: " + error.message);
      pause_ms = kPauseAfterError_ms;
    }
    // There may be a newer one by now; of a map that is long in the making the server gives an
    // older one.
    setTimeout(() => {
      isFetching = false;
      keepUp();
    }, pause_ms);
  };
  // Gains cost the server time: they are asked for while somebody wants to see them.
  const wish = page.element("ask-gains");
  let isAsking = false;
  const withdrawGains = () => {
    gainsPlan = "";
    page.element("gains-facts").textContent = "";
    Object.assign(page.data, {landscape: null, voxel_gains: null});
    page.showParts();
    showGains(null, () => new ArrayBuffer(0));
  };
  const keepUpWithGains = async () => {
    if (isAsking || !wish.checked || gainsPlan === plan) return;
    isAsking = true;
    let pause_ms = kGainsPause_ms;
    try {
      const {answer, bytes} = await fetchGains();
      await showGains(answer, bytes);
      if (!wish.checked) withdrawGains();  // meanwhile
    } catch (error) {
      page.element("gains-facts").textContent = "they cannot be shown: " + error.message;
      pause_ms = kPauseAfterError_ms;
    }
    setTimeout(() => {
      isAsking = false;
      keepUpWithGains();
    }, pause_ms);
  };
  wish.addEventListener("change", () => wish.checked ? keepUpWithGains() : withdrawGains());
  onState = () => {
    const newest = `${state.map.split("-")[0]}-${state.plan}`;  // of this run of the server
    if (plan !== newest) {
      plan = newest;
      page.data.answer = state.answer;
      page.showParts();
      showAnswer();
    }
    tellState();
    keepUp();
    keepUpWithGains();
  };
  if (state) onState();
};
