/** One trip: a goal, all waypoints as one action, or, where the robot has none for that, one goal after the other. */
import type { Channel } from '../channel';
import type { Connection } from '../connection';
import type { GoalState } from '../generated/messages';
import { isObject, textOf, type JsonObject } from '../json';
import { missed, order, progress, type Order, type Progress } from './drivers';
import { poseOf, type Waypoint } from './waypoints';

const OVER = /succeeded|aborted|rejected|cancel(l)?ed|preempted|recalled|lost/i;
const REACHED = /succeeded/i;

/** How a trip stands. */
export interface Standing {
  state: string;
  text: string;
  progress: Progress;
  /** What became of each waypoint: '', 'driving', 'reached', 'missed'. */
  marks: string[];
  over: boolean;
}

interface Server {
  name: string;
  type: string;
}

/** A trip that is under way until it is over or cancelled. */
export class Trip {
  private channel: Channel | null = null;
  private at = 0;
  private round = 0;
  private standing: Standing;

  /**
   * Without `atOnce` the waypoints are goals one after the other: one that is missed does not end
   * the trip, as with Nav2's waypoint follower.
   */
  constructor(
    private readonly connection: Connection,
    private readonly server: Server,
    private readonly waypoints: readonly Waypoint[],
    private readonly options: { atOnce: boolean; loops: number },
    private readonly tell: (standing: Standing) => void,
  ) {
    this.standing = {
      state: 'sent',
      text: '',
      progress: {},
      marks: waypoints.map(() => ''),
      over: false,
    };
    this.send();
  }

  /** Give it up; the server is told. */
  cancel(): void {
    this.close();
    if (!this.standing.over) this.change({ state: 'cancelled', over: true });
  }

  private send(): void {
    const poses = this.waypoints.map(poseOf);
    const { atOnce, loops } = this.options;
    if (!atOnce) this.mark(this.at, 'driving');
    this.open(order(this.server, atOnce ? poses : [poses[this.at]], loops));
  }

  private open({ action, type, goal }: Order): void {
    this.channel = this.connection.open(
      'action',
      { action, type, goal },
      {
        onData: (value) => this.take(value as unknown as GoalState),
        onFailed: (problem) => this.fail(problem.message),
        onEnded: (problem) => problem && this.fail(problem.message),
      },
    );
  }

  private take({ state, text, feedback, result }: GoalState): void {
    if (this.standing.over) return;
    const news = isObject(feedback) ? progress(feedback) : {};
    this.change({ state, text, progress: { ...this.standing.progress, ...news } });
    if (news.current !== undefined) this.passed(news.current);
    if (news.remaining !== undefined) this.passed(this.waypoints.length - news.remaining);
    if (OVER.test(state)) this.finish(state, isObject(result) ? result : {});
  }

  /** The waypoint of a number is driven to now. */
  private passed(current: number): void {
    this.standing.marks = this.waypoints.map((_, index) =>
      index < current ? 'reached' : index === current ? 'driving' : '',
    );
    this.change({});
  }

  private finish(state: string, result: JsonObject): void {
    const reached = REACHED.test(state);
    this.close();
    if (this.options.atOnce) {
      const misses = missed(result);
      this.standing.marks = this.standing.marks.map((mark, index) =>
        misses.includes(index)
          ? 'missed'
          : reached
            ? 'reached'
            : mark === 'driving'
              ? 'missed'
              : mark,
      );
      return this.change({ over: true, text: textOf(result, 'error_msg') || this.standing.text });
    }
    this.mark(this.at, reached ? 'reached' : 'missed');
    this.at += 1;
    if (this.at === this.waypoints.length && this.round < this.options.loops) {
      this.round += 1;
      this.at = 0;
      this.standing.marks = this.waypoints.map(() => '');
    }
    if (this.at < this.waypoints.length) return this.send();
    const misses = this.standing.marks.filter((mark) => mark === 'missed').length;
    if (this.waypoints.length === 1) this.change({ over: true });
    else
      this.change({
        over: true,
        state: misses ? 'finished' : 'succeeded',
        text: misses ? `${misses} of ${this.waypoints.length} waypoints were missed` : '',
      });
  }

  private fail(text: string): void {
    this.close();
    if (!this.standing.over) this.change({ state: 'failed', text, over: true });
  }

  private close(): void {
    this.channel?.close();
    this.channel = null;
  }

  private mark(index: number, mark: string): void {
    this.standing.marks = this.standing.marks.map((each, at) => (at === index ? mark : each));
  }

  private change(news: Partial<Standing>): void {
    this.standing = { ...this.standing, ...news };
    this.tell(this.standing);
  }
}
