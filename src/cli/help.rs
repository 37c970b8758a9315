//! Chinese texts of `--help` and of the faults of arguments: one table translates the English of
//! `args`.
//!
//! The printer of the help knows only English headings; they are translated in its output.

use super::args::Args;
use super::files::FileRefusal;
use crate::diag::{Both, Diagnostic};
use crate::figure::list::LIST;
use crate::scene::Lang;
use clap::error::{ContextKind, ContextValue, ErrorKind};
use clap::{Arg, Command, CommandFactory};
use std::ffi::OsString;

/// Returns the value of a global option such as `--lang`, before the arguments are parsed.
pub fn given<T>(
    arguments: &[OsString],
    option: &str,
    named: impl Fn(&str) -> Option<T>,
) -> Option<T> {
    let words: Vec<&str> =
        arguments.iter().skip(1).filter_map(|a| a.to_str()).take_while(|a| *a != "--").collect();
    let apart = words.windows(2).filter(|w| w[0] == option).filter_map(|w| named(w[1]));
    let together = words.iter().filter_map(|w| named(w.strip_prefix(option)?.strip_prefix('=')?));
    apart.chain(together).next()
}

/// Returns a fault of the arguments as a diagnostic: its first sentence, and the usage as advice.
pub fn diagnostic(e: &clap::Error) -> Diagnostic {
    let parts = |text: String, mark: &str| {
        let (said, rest) = text.split_once("\n\n").unwrap_or((&text, ""));
        let line = |part: &str| part.split_whitespace().collect::<Vec<_>>().join(" ");
        (line(said.strip_prefix(mark).unwrap_or(said)), line(rest))
    };
    let (en, zh) = (parts(e.render().to_string(), "error: "), parts(usage(e), "错误："));
    Diagnostic::error("usage", Both { en: en.0, zh: zh.0 }).help(Both { en: en.1, zh: zh.1 })
}

/// Returns the language of the help if the arguments choose none: that of the system.
pub fn of_the_machine() -> Lang {
    // The variables in the order of their priority; an empty one is ignored.
    let set = ["LC_ALL", "LC_MESSAGES", "LANG"]
        .into_iter()
        .filter_map(std::env::var_os)
        .find(|v| !v.is_empty());
    match set {
        Some(name) if name.to_str().is_some_and(|n| n.starts_with("zh")) => Lang::Zh,
        _ => Lang::En,
    }
}

/// Returns the program's arguments with their help in a language.
pub fn command(lang: Lang) -> Command {
    let command = Args::command();
    match lang {
        Lang::En => command,
        Lang::Zh => chinese(command),
    }
}

fn chinese(mut command: Command) -> Command {
    command.build();
    let names: Vec<String> = command.get_subcommands().map(|c| c.get_name().to_owned()).collect();
    let mut command = translated(command, "");
    for name in names {
        command = command.mut_subcommand(&name, |c| translated(c, &name));
    }
    // Chinese has no spaces at which the printer could break a line: the terminal breaks it.
    command.term_width(0)
}

/// Translates one command and its arguments.
fn translated(command: Command, name: &str) -> Command {
    let command = match entry(name, "") {
        Some(about) => command.about(about).long_about(about),
        None => command,
    };
    let command = match entry(name, "*after") {
        Some(after) => command.after_help(after),
        None => command,
    };
    command.mut_args(|arg: Arg| {
        match entry(name, arg.get_id().as_str()).or_else(|| entry("*", arg.get_id().as_str())) {
            Some(help) => arg.help(help).long_help(help),
            None => arg,
        }
    })
}

fn entry(command: &str, argument: &str) -> Option<&'static str> {
    WORDS.iter().find(|w| (w.0, w.1) == (command, argument)).map(|w| w.2)
}

/// Translates the headings and the names of choices of a printed help into Chinese.
fn headings(text: &str) -> String {
    let figures = LIST.iter().map(|e| (e.about[0], e.about[1]));
    HEADINGS
        .iter()
        .copied()
        .chain(figures)
        .fold(text.to_owned(), |text, (en, zh)| text.replace(en, zh))
}

/// Returns the faults of the arguments, or the requested help, in Chinese.
pub fn usage(e: &clap::Error) -> String {
    let value = |kind| e.get(kind).map(|v: &ContextValue| v.to_string()).unwrap_or_default();
    let (argument, given) = (value(ContextKind::InvalidArg), value(ContextKind::InvalidValue));
    let near = |kind| e.get(kind).map_or(String::new(), |v| format!("\n  是否想写 '{v}'？"));
    let said = match e.kind() {
        ErrorKind::InvalidValue if given.is_empty() => format!("参数 '{argument}' 缺少值"),
        ErrorKind::InvalidValue => {
            let choices = e
                .get(ContextKind::ValidValue)
                .map_or(String::new(), |v| format!("\n  可选值：{v}"));
            format!(
                "参数 '{argument}' 的值 '{given}' 无效{choices}{}",
                near(ContextKind::SuggestedValue)
            )
        }
        ErrorKind::ValueValidation => {
            format!("参数 '{argument}' 的值 '{given}' 无效：{}", refused(e))
        }
        ErrorKind::UnknownArgument => {
            format!("没有参数 '{argument}'{}", near(ContextKind::SuggestedArg))
        }
        ErrorKind::InvalidSubcommand => {
            format!(
                "没有命令 '{}'{}",
                value(ContextKind::InvalidSubcommand),
                near(ContextKind::SuggestedSubcommand)
            )
        }
        ErrorKind::MissingRequiredArgument => format!("缺少参数：{argument}"),
        ErrorKind::MissingSubcommand => "缺少命令".to_owned(),
        ErrorKind::ArgumentConflict => {
            format!("参数 '{argument}' 与 '{}' 不能同用", value(ContextKind::PriorArg))
        }
        ErrorKind::NoEquals
        | ErrorKind::TooManyValues
        | ErrorKind::TooFewValues
        | ErrorKind::WrongNumberOfValues => {
            format!("参数 '{argument}' 的值的个数不对")
        }
        ErrorKind::InvalidUtf8 => "参数不是 UTF-8 文字".to_owned(),
        _ => return headings(&e.render().to_string()),
    };
    let usage = e.get(ContextKind::Usage).map_or(String::new(), |u| format!("\n\n{u}"));
    headings(&format!("错误：{said}{usage}\n\n详细说明请用 '--help'。\n"))
}

/// Returns the reason for which the library refuses a value.
fn refused(e: &clap::Error) -> String {
    let source = std::error::Error::source(e);
    if let Some(FileRefusal(words)) = source.and_then(|s| s.downcast_ref()) {
        return words.zh.clone();
    }
    let why = source.map(ToString::to_string).unwrap_or_default();
    match why.split_once(" is not in ") {
        Some((number, range)) => format!("{number} 不在 {range} 之内"),
        None if why.contains("digit") => "不是整数".to_owned(),
        None => why,
    }
}

/// Returns the help, or the faults of the arguments, in the language of the help.
pub fn said(e: &clap::Error, lang: Lang) -> String {
    match lang {
        Lang::En => e.render().to_string(),
        Lang::Zh => usage(e),
    }
}

/// Texts that the printer of the help writes itself, and the choices of an argument; those of
/// figures come from their list.
const HEADINGS: &[(&str, &str)] = &[
    ("Usage:", "用法："),
    ("Commands:", "命令："),
    ("Arguments:", "参数："),
    ("Options:", "选项："),
    ("Possible values:", "可选值："),
    ("[default: ", "[默认："),
    ("[possible values: ", "[可选值："),
    ("Velocities", "速度"),
    ("Accelerations", "加速度"),
    ("Outlines", "轮廓"),
    ("Text, for drawing programs", "文字，供绘图软件编辑"),
];

/// Command, argument, help. An empty argument is the command itself, `*` any command.
const WORDS: &[(&str, &str, &str)] = &[
    ("", "", "用图解法求解平面机构：列矢量方程，作速度多边形和加速度多边形，图面与教科书一致"),
    (
        "",
        "*after",
        "开始：hodograph new shaper > shaper.json && hodograph draw shaper.json -o out/\n\n退出码：0 完成；1 文件不能写入（`diff`：两图不同；`shards verify`：有分块缺少或损坏）；2 机构文件有误；3 作图与解析不符（程序的错误）；4 完成，但有的量在该位置无值（死点）",
    ),
    ("*", "help", "显示说明"),
    ("*", "version", "显示版本"),
    ("*", "lang", "输出的语言（默认：机构文件的语言，否则 en）"),
    (
        "*",
        "errors",
        "标准错误上的错误、警告和提示的形式：text，或整个运行一份 JSON 文档 json（`hodograph schema --diagnostics`）",
    ),
    ("*", "scene", "机构文件；`-` 为标准输入"),
    (
        "*",
        "set",
        "改变机构文件中参数的值，或改变时间规律的时刻 t：NAME=VALUE；不带单位的数沿用原单位",
    ),
    ("*", "notation", "记号体系：en（极点 o，上标 c、rel）或 cn（极点 p，上标 k、r）"),
    (
        "*",
        "style",
        "样式：print（白底黑线）、slides（各构件一种颜色）、dark，或以 .json 结尾的样式文件",
    ),
    (
        "*",
        "font",
        "自备的字体（.otf、.ttf），用于字母、数字和文字；可写两次，分别为正体和斜体；优先于样式中的字体。缺少的字符用内置字体",
    ),
    (
        "*",
        "format",
        "-o 没有这样的结尾时的格式，如 svg,pdf；多种格式时文件名各加结尾（`-o -` 默认为 svg）",
    ),
    ("sweep", "format", "-o 没有这样的结尾时的格式（标准输出默认为 csv）"),
    ("batch", "format", "-o 没有这样的结尾时的格式（`-o -` 默认为 csv，有 --shard 时为 parquet）"),
    (
        "worksheet",
        "format",
        "-o 没有这样的结尾时的格式，如 pdf,html；多种格式时文件名各加结尾（`-o -` 默认为 html）",
    ),
    (
        "animate",
        "format",
        "-o 没有这样的结尾时的格式，如 gif,svg；多种格式时文件名各加结尾（`-o -` 默认为 svg）",
    ),
    (
        "path",
        "format",
        "-o 没有这样的结尾时的格式，如 svg,pdf；多种格式时文件名各加结尾（默认：svg）",
    ),
    (
        "*",
        "id_prefix",
        "SVG 中所有 id 的前缀，使多幅图可放在同一页面：以字母开头，后接字母、数字、- 或 _，如 fig1-",
    ),
    ("*", "digits", "结果的有效数字，1 到 30 位；不能确定的不显示，并说明原因"),
    (
        "*",
        "over",
        "使什么运动：原动件，写其名称（`phi_1`、`s_B`、`l_BC`、`driver2`），其余不动；或 t，即时间：各原动件按其规律或速度同时运动（默认：有时间规律时为时间，否则为第一个原动件）",
    ),
    ("limits", "over", "使哪个原动件运动，写其名称（`phi_1`、`s_B`、`l_BC`、`driver2`）；其余不动"),
    ("*", "from", "起点，带单位（默认：0，或原动件所能到达之处）"),
    ("*", "to", "终点（默认：一整转，或原动件所能到达之处；时间为所求瞬时的两倍）"),
    (
        "*",
        "steps",
        "等分的步数；两端都是数据行（默认：360；`batch` 不分步，各机构取机构文件的位置）",
    ),
    ("*", "find", "改求其他量，如 v_E,a_E,omega_3"),
    ("draw", "", "绘图：机构运动简图、矢量方程表、速度多边形和加速度多边形、结果（SVG、PNG、PDF）"),
    (
        "draw",
        "output",
        "输出的文件夹，或以 .svg、.png、.pdf 结尾的一个文件，或 `-`（标准输出）；尚不存在且名称带点的文件夹以 / 结尾",
    ),
    (
        "draw",
        "format",
        "文件的格式，如 svg,pdf；单个文件由 -o 的结尾决定（默认：文件夹为 svg,png，标准输出为 svg）",
    ),
    ("draw", "figure", "画哪些图，各成文件：整张图或其中的部分"),
    ("draw", "vectors", "在机构运动简图上画各点的这种矢量"),
    (
        "draw",
        "poses",
        "首个原动件的位置数：把各位置的机构和多边形画成一张表，采用同一组比例尺；与 `--figure mechanism` 同用时叠画在机构后面",
    ),
    (
        "draw",
        "path",
        "在机构运动简图上画这些点在首个原动件行程中的轨迹；与 `--poses` 同用时在多边形后面画矢端曲线",
    ),
    (
        "draw",
        "dimensions",
        "在机构运动简图上以机构文件的单位标注给定的长度和角度，图下列出其余已知条件，据此可重画机构",
    ),
    (
        "draw",
        "width",
        "图幅宽度，如书的一栏 80mm：先把字缩小到仍可读，再略去一些内容并说明；仍放不下则不画",
    ),
    ("draw", "text", "SVG 中的文字：轮廓在各处显示相同；可编辑的文字取决于显示它的机器的字体"),
    ("draw", "steps", "每个作图步骤一幅图，附该步的说明"),
    (
        "draw",
        "drafting",
        "手工作图时各结果的误差，给出作图误差，如 0.1mm（默认：机构文件的值，否则 0.1 mm）",
    ),
    ("draw", "pick", "综合文件：取第几个方案，按 `hodograph synth` 的次序从 1 数起"),
    ("draw", "dpi", "PNG 的分辨率（dpi）"),
    ("lesson", "", "生成教学演示：一个 HTML 页面，逐步作图，可拖动曲柄"),
    ("lesson", "output", "要写的页面，或 `-`（标准输出）（默认：按机构文件命名）"),
    ("lesson", "reveal", "改为 reveal.js 的片段：各部分逐步显示的内嵌 SVG"),
    ("lesson", "width", "与 --reveal 同用：片段的宽度，如 240mm；先缩小图和字，再把各图上下排列"),
    ("lesson", "positions", "一整转或整个行程中的位置数，8 到 360；运动急变处自动加密"),
    ("lesson", "driver", "使第几个原动件运动，从 1 数起；含 `motions` 的文件：演示第几个运动"),
    ("lesson", "pick", "综合文件：取第几个方案，按 `hodograph synth` 的次序从 1 数起"),
    ("diff", "", "比较两图（SVG、PNG）：移动的矢量、图元、文字、像素；不同时退出码为 1"),
    ("diff", "*after", "退出码同 diff(1)：0 两图相同；1 不同；2 文件不能读或不能写"),
    ("diff", "old", "原图：SVG 或 PNG"),
    ("diff", "new", "现图，与原图同类"),
    (
        "diff",
        "output",
        "把两图叠画到以 .png 结尾的文件：仅在 A 中的为红色，仅在 B 中的为蓝色，共有的为灰色",
    ),
    (
        "diff",
        "tolerance",
        "图元允许移动的毫米数（默认：0.01）；给出时，像素只在同时给出 `--pixels` 时起作用",
    ),
    ("diff", "pixels", "允许这么多像素的某一通道相差超过一级（默认：0）"),
    ("diff", "json", "差别为 JSON"),
    ("solve", "", "求解所求的量：数值、单位、转向，作图与解析对照；在运动不确定位置给出两种运动"),
    ("solve", "json", "结果为 JSON，国际单位制，给出两种方法的结果及其差"),
    (
        "solve",
        "drafting",
        "手工作图时的误差，给出作图误差，如 0.1mm（默认：机构文件的值，否则 0.1 mm）：各结果、各交点的误差，以及误差为 1 % 的比例尺",
    ),
    ("solve", "steps", "同时列出作图步骤和图上量得的长度"),
    ("plan", "", "按求解次序列出矢量方程，并说明各项取舍的原因；用 JSON 时还给出工作量"),
    ("plan", "json", "计划为 JSON，附各项计数：杆组、方程、矢量、未知数、数值"),
    ("plan", "figure", "同时排版图面，以统计标注"),
    ("worksheet", "", "生成作业：题目及其逐步解答（PDF、HTML、Markdown、Typst）"),
    (
        "worksheet",
        "output",
        "以 .pdf、.html、.md 或 .typ 结尾的文件，或 `-`（标准输出）；后两种的图以 SVG 文件放在旁边",
    ),
    ("worksheet", "problem_only", "只要题目：已知与所求，不含答案"),
    ("worksheet", "solution", "只要解答"),
    (
        "worksheet",
        "find_the_mistake",
        "以一种错误解法为题目：机构文件所写的，否则第一种典型错误；也可按名称指定",
    ),
    ("worksheet", "mobility", "改问自由度与杆组：解答计数并说明理由，绘出拆开的杆组"),
    ("worksheet", "loops", "用解析法求解：列出封闭矢量方程，给出各未知量的公式和数值"),
    ("worksheet", "pick", "综合文件：取第几个方案，按 `hodograph synth` 的次序从 1 数起"),
    ("accuracy", "", "衡量精度的代价：各种求解方法的误差和时间，列表并作图"),
    ("accuracy", "toward_toggle", "同时计算一系列趋近首个原动件最近极限的位置，直到 1e-12"),
    (
        "accuracy",
        "output",
        "把精度与代价的图写入以 .svg、.png 或 .pdf 结尾的文件；`-` 为标准输出，代替表格",
    ),
    ("accuracy", "json", "表格为 JSON"),
    ("accuracy", "patience", "每种方法重复计算的毫秒数；取时间的中位数"),
    ("sweep", "", "使原动件或参数遍历一系列值：各位置的结果列成表（CSV、JSON、NumPy、Parquet）"),
    (
        "sweep",
        "over",
        "遍历什么：原动件（`driver`、`driver2`、`phi_1`、`s_B`、`l_BC`），t（时间规律的时间，有规律时为默认），或机构文件的参数",
    ),
    ("sweep", "output", "写入以 .csv、.json、.npy 或 .parquet 结尾的文件（默认：`-`，即标准输出）"),
    (
        "batch",
        "",
        "在网格上或随机改变参数：许多机构，各取一个或多个位置，合成一张表（CSV、NumPy、Parquet）",
    ),
    ("batch", "vary", "参数及其取值：NAME=FROM..TO:N；不带单位的数沿用原单位"),
    ("batch", "random", "随机机构的个数；不再取所有组合"),
    ("batch", "seed", "随机数种子；不同的种子给出不同的随机机构"),
    (
        "batch",
        "output",
        "写入以 .csv、.npy 或 .parquet 结尾的文件，或 `-`（标准输出）；中断后可由此继续；有 --shard 时为文件夹",
    ),
    (
        "batch",
        "shard",
        "只计算批量计算的一片，如 3/100，结果分块写入 -o 的文件夹；由 `shards` 合并",
    ),
    ("batch", "per_part", "每个分块的机构数（默认：每块约一百万个数）；单个机构耗时较长时宜取小些"),
    ("shards", "", "检查并合并由多台机器或多个任务算出的各分块（`batch --shard`）"),
    (
        "shards",
        "action",
        "missing：列出缺少的分块；verify：读取所有分块并核对校验和；compact：合并成一张表，与单独运行 `batch` 所得逐字节相同",
    ),
    ("shards", "folder", "`batch --shard` 的文件夹"),
    ("shards", "of", "用于 missing：列出 N 片中缺少分块的各片，写法同 `sbatch --array`"),
    ("shards", "remove_damaged", "用于 verify：删除损坏的分块，以便用同一 `batch` 重新计算"),
    ("shards", "output", "用于 compact：表格文件，扩展名与各分块相同，或 `-`（标准输出）"),
    ("curves", "", "线图：位移、速度、加速度随原动件位置的变化，标出极值"),
    ("curves", "polar", "以所求矢量的矢端曲线图代替线图：轴承反力的极坐标图、速度的矢端曲线"),
    (
        "curves",
        "output",
        "以 .svg、.png（各图上下排列）或 .pdf（A4 页面）结尾的文件，或 `-`（标准输出）",
    ),
    ("path", "", "在机构上画点的轨迹（连杆曲线），及其速度和加速度的矢端曲线"),
    ("path", "*after", "曲线数值的表：hodograph sweep SCENE --find x_E,y_E,v_E,a_E -o curves.csv"),
    ("path", "point", "画哪些点的轨迹，如 E 或 E,F"),
    ("path", "against", "活动构件：画从该构件上看到的相对运动轨迹，画在给定位置的该构件上"),
    ("path", "poses", "把机构在原动件等间隔的这么多个位置上叠画"),
    (
        "path",
        "marks",
        "原动件等间隔的位置数，在轨迹和矢端曲线上编相同的号（默认：同 --poses，否则 12）",
    ),
    (
        "path",
        "output",
        "以 .svg、.png 或 .pdf 结尾的文件，或 `-`（标准输出）（默认：按机构文件命名）",
    ),
    ("animate", "", "运动动画：机构及其多边形随原动件运动（GIF、SVG 动画、逐帧 PNG）"),
    (
        "animate",
        "*after",
        "由各帧制作影片：ffmpeg -framerate 12 -i turn-%03d.png -pix_fmt yuv420p turn.mp4",
    ),
    ("animate", "frames", "原动件等间隔的位置数：转一整周，或在行程两端之间往返"),
    ("animate", "seconds", "一个周期的时长（秒）"),
    ("animate", "dpi", "GIF 和 PNG 的分辨率（每英寸点数）；宽和高均为偶数像素"),
    (
        "animate",
        "output",
        "以 .gif、.svg（在浏览器中自动播放）或 .png（每帧一个：turn-001.png……）结尾的文件，或 `-`（标准输出）",
    ),
    ("mobility", "", "计算自由度：构件和运动副、复合铰链、局部自由度、虚约束、各原动件下的杆组"),
    ("mobility", "*after", "只需构件和运动副：没有原动件和尺寸时，由尺寸决定的问题不作结论"),
    ("mobility", "json", "结果为 JSON"),
    (
        "mobility",
        "output",
        "拆杆组图的文件，以 .svg、.png 或 .pdf 结尾，或 `-`（标准输出，代替报告）；机构位置须已给定",
    ),
    ("cam", "", "盘形凸轮转一周：位移、速度、加速度、冲击、压力角、曲率；廓线（CSV、DXF）"),
    ("cam", "output", "两幅图的文件夹：从动件运动线图、反转法绘制的廓线"),
    ("cam", "format", "图的格式，如 svg,pdf（默认：svg,png）"),
    (
        "cam",
        "profile",
        "把廓线（mm）写入以 .csv（每个转角一行）或 .dxf（供加工）结尾的文件；`-` 为标准输出，以 CSV 代替报告",
    ),
    ("cam", "steps", "廓线上一周的点数"),
    ("cam", "cam", "机构文件中的第几个凸轮，从 1 数起（默认：全部）"),
    ("cam", "json", "结果为 JSON，国际单位制，角度为弧度"),
    ("cam", "dpi", "PNG 的分辨率（dpi）"),
    ("limits", "", "原动件的活动范围、极限位置和行程、行程速度变化系数、传动角、格拉斯霍夫类型"),
    ("limits", "find", "改列这些量在整个运动中的最大值、最小值和零点，如 v_C,a_C"),
    ("limits", "ranges", "四杆机构：其余三杆不变时，各杆长在什么范围内属于哪种类型"),
    (
        "limits",
        "flywheel",
        "在所给载荷下，使运转不均匀系数为此值（如 1/30 或 0.03）的飞轮转动惯量（装在原动件轴上）",
    ),
    ("limits", "json", "结果为 JSON，国际单位制"),
    ("centres", "", "速度瞬心：各瞬心的求法和位置，以及由瞬心求得的速度"),
    ("centres", "*after", "带瞬心多边形的图：hodograph draw SCENE --figure centres -o centres.svg"),
    (
        "centres",
        "drafting",
        "手工作图时各瞬心位置的误差，给出作图误差，如 0.1mm（默认：机构文件的值，否则 0.1 mm）",
    ),
    ("centres", "json", "结果为 JSON，国际单位制"),
    (
        "inversions",
        "",
        "机构的倒置：依次以各构件为机架，给出杆长条件类型、整周转动的构件、行程和轮系传动比；每个都是机构文件",
    ),
    (
        "inversions",
        "*after",
        "并列的图：hodograph draw SCENE --figure inversions -o inversions.svg",
    ),
    (
        "inversions",
        "output",
        "把各倒置机构的文件写入该文件夹；与 --pick 同用时写入以 .json 结尾的文件或 `-`（标准输出）",
    ),
    ("inversions", "pick", "只取以该构件为机架的倒置机构；不写 -o 时输出其机构文件"),
    ("inversions", "json", "结果为 JSON，国际单位制"),
    (
        "curvature",
        "",
        "轨迹的曲率：瞬心、拐点圆、曲率中心（博比利尔、欧拉–萨瓦里）、加速度瞬心、鲍尔点",
    ),
    (
        "curvature",
        "*after",
        "图：hodograph draw SCENE --figure curvature,centrodes -o out/；find 中可写 rho_E O_E J_2 d_2 K_2 u_2 p_2",
    ),
    ("curvature", "link", "构件（默认：既不绕固定铰链转动、也不沿机架滑动的所有构件）"),
    ("curvature", "against", "相对哪个构件（默认：机架）"),
    ("curvature", "point", "求哪些点的轨迹（默认：构件上所有的点）"),
    ("curvature", "steps", "逐步给出尺规作图"),
    (
        "curvature",
        "drafting",
        "手工作图时各位置和长度的误差，给出作图误差，如 0.1mm（默认：机构文件的值，否则 0.1 mm）",
    ),
    ("curvature", "json", "结果为 JSON，国际单位制"),
    ("curvature", "centrodes", "连同瞬心在两平面中的轨迹（瞬心线）"),
    (
        "loops",
        "",
        "用解析法（复数矢量法）求解：列出封闭矢量方程及其实部和虚部，给出位置、速度、加速度的公式和数值",
    ),
    (
        "loops",
        "*after",
        "在机构上画出各封闭矢量多边形：hodograph draw SCENE --figure loops -o loops.svg",
    ),
    ("loops", "json", "结果为 JSON，国际单位制，角为弧度"),
    ("composite", "", "点的合成运动：哪些动点和动系可用、为何不可用，以及运动的各分量"),
    (
        "composite",
        "*after",
        "带平行四边形的图：hodograph draw SCENE --figure composite -o composite.svg",
    ),
    ("composite", "json", "结果为 JSON，国际单位制"),
    ("attempts", "", "错误解法：本题中可能出现哪些典型错误、后果如何、错在哪里"),
    (
        "attempts",
        "*after",
        "错误解法与正确解法对照图：hodograph draw SCENE --figure attempts -o attempts.svg",
    ),
    ("attempts", "all", "列出所有典型错误，即使机构文件已写明某些错误"),
    ("attempts", "json", "结果为 JSON，国际单位制"),
    (
        "synth",
        "",
        "按综合文件设计机构：列出全部方案的尺寸、误差、缺陷和传动角，每个方案都是机构文件",
    ),
    (
        "synth",
        "*after",
        "起步：hodograph new time-ratio > wish.json && hodograph synth wish.json；作图：hodograph draw wish.json -o out/；题目与解答：hodograph worksheet wish.json -o sheet.pdf",
    ),
    ("synth", "file", "综合文件；`-` 表示标准输入"),
    ("synth", "set", "改变文件中参数的值：NAME=VALUE；不带单位的数沿用原单位"),
    ("synth", "speed", "搜索用时及每秒计算的位置数（写到标准错误）"),
    ("synth", "pick", "第几个方案，按表中次序从 1 数起"),
    ("synth", "output", "把所选方案的机构文件写入这个文件或 `-`（标准输出）（默认：第一个方案）"),
    ("synth", "json", "各方案为 JSON，国际单位制，附机构文件"),
    ("synth", "steps", "同时列出尺规作图步骤和图上量得的长度"),
    ("readings", "", "原图缺失时的几种读法：各自的结果，以及哪一种得到原书所印数值"),
    ("readings", "json", "结果为 JSON，国际单位制"),
    ("new", "", "写出模板的机构文件，可改参数"),
    ("new", "template", "模板的名称（见 `hodograph templates`）"),
    ("new", "set", "改变参数的值：NAME=VALUE；不带单位的数沿用原单位"),
    ("new", "output", "写入这个文件（默认：`-`，即标准输出）"),
    ("edit", "", "在浏览器中编辑文件：本机地址上的页面，保存到该文件，并随其他编辑器的修改而更新"),
    ("edit", "scene", "文件：机构文件、综合文件，或无机构的运动文件"),
    ("edit", "new", "文件不存在时，从空白的机构文件开始"),
    ("edit", "port", "地址的端口（默认：空闲端口）"),
    ("edit", "no_open", "只输出地址，不打开浏览器"),
    ("edit", "page", "页面文件 hodograph.html（默认：程序内含的、程序旁边的，或其源码目录中的）"),
    ("templates", "", "列出各模板及其参数"),
    ("explain", "", "解释错误、警告和提示的代码：原因与对策；或列出全部代码"),
    ("explain", "*after", "全部代码的页面：docs/errors.md"),
    ("explain", "code", "信息首行中的代码，如 dead-centre（默认：列出全部代码）"),
    ("explain", "json", "结果为 JSON，含两种语言"),
    ("schema", "solved", "改为 `solve --json`、`synth --json` 结果的 JSON Schema"),
    ("schema", "diagnostics", "改为 `--errors json` 文档的 JSON Schema"),
    ("schema", "synthesis", "改为综合文件格式的 JSON Schema"),
    ("schema", "motions", "改为无机构运动文件格式的 JSON Schema"),
    ("schema", "", "输出机构文件格式的 JSON Schema"),
    ("help", "", "显示本说明或某命令的说明"),
];

#[cfg(test)]
mod tests {
    use super::*;

    fn is_chinese(text: &str) -> bool {
        text.chars().any(|c| ('\u{4e00}'..='\u{9fff}').contains(&c))
    }

    #[test]
    fn every_command_and_argument_is_told_in_chinese() {
        let mut command = command(Lang::Zh);
        assert!(is_chinese(&command.get_about().unwrap().to_string()));
        // Skips the list of commands, which `help` repeats.
        for c in command.get_subcommands_mut().filter(|c| c.get_name() != "help") {
            let name = c.get_name().to_owned();
            assert!(
                c.get_about().is_some_and(|a| is_chinese(&a.to_string())),
                "{name}: no Chinese in WORDS"
            );
            for arg in c.get_arguments() {
                let help = arg.get_help().map(ToString::to_string).unwrap_or_default();
                assert!(
                    is_chinese(&help),
                    "{name} {}: no Chinese in WORDS, but {help:?}",
                    arg.get_id()
                );
            }
            let text = headings(&c.render_long_help().to_string());
            // Only names remain in Latin letters: no two lower-case words follow one another.
            let english = text.lines().find(|l| {
                let small = |w: &str| w.len() > 1 && w.chars().all(|c| c.is_ascii_lowercase());
                let words: Vec<&str> = l.split(' ').collect();
                words.windows(3).any(|w| w.iter().all(|w| small(w)))
            });
            assert_eq!(english, None, "{name}:\n{text}");
        }
    }

    #[test]
    fn no_entry_is_left_over() {
        let command = command(Lang::Zh);
        for (c, a, _) in WORDS.iter().filter(|w| w.1 != "*after") {
            let all: Vec<&Command> =
                std::iter::once(&command).chain(command.get_subcommands()).collect();
            let mut meant = all.iter().filter(|x| {
                *c == "*"
                    || x.get_name() == *c
                    || c.is_empty() && x.get_name() == command.get_name()
            });
            assert!(
                meant.any(|x| a.is_empty() || x.get_arguments().any(|arg| arg.get_id() == *a)),
                "{c} {a}: there is no such argument"
            );
        }
    }

    #[test]
    fn the_language_is_known_before_the_arguments_are_read() {
        let of = |line: &str| {
            given(&line.split(' ').map(OsString::from).collect::<Vec<_>>(), "--lang", Lang::named)
        };
        assert_eq!(of("hodograph solve --lang zh x.json"), Some(Lang::Zh));
        assert_eq!(of("hodograph solve --lang=en --help"), Some(Lang::En));
        assert_eq!(of("hodograph solve -- --lang zh"), None);
        assert_eq!(of("hodograph solve --lang"), None);
    }
}
