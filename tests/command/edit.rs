//! A live cell that is served: `edit`. What a person does with it is tested in a browser (`tests/browser`).

#[cfg(unix)]
use super::served::{all, ask, command, line_after, post, start};
use super::*;
use std::net::TcpListener;
#[cfg(unix)]
use std::{fs::Permissions, os::unix::fs::PermissionsExt};

#[test]
fn edit_refuses_unusable_files_before_any_work() {
    let folder = folder();
    let dir = folder.path();
    let refused = |arguments: &[&str], fragments: &[&str]| {
        platewash(dir, &[&["edit", "--no-open"], arguments].concat()).refused(2, fragments);
    };
    refused(&["--scenario", "kitchn"], &["kitchn", "shipped", "kitchen-rim"]);
    std::fs::write(dir.join("broken.toml"), "name = \n").unwrap();
    refused(&["--scenario", "broken.toml"], &["broken.toml", "line 1"]);
    std::fs::write(dir.join("other.toml"), "[wash]\nturn = 3\n").unwrap();
    refused(
        &["--scenario", "other.toml"],
        &["other.toml, line 2", "did you mean 'wash.turns'?"],
    );
    refused(&["--urdf", "arm.urdf"], &["--urdf", "robot.urdf"]);
    refused(&["--seed", "-1"], &["--seed"]);
    refused(
        &["--save-as", "other.toml/cell.toml"],
        &["cell.toml", "other.toml is not a folder"],
    );
    refused(&["--save-as", ".."], &["--save-as .."]);
    let taken = TcpListener::bind("127.0.0.1:0").unwrap();
    let port = taken.local_addr().unwrap().port().to_string();
    refused(&["--port", &port], &["--port: cannot listen on 127.0.0.1:", &port]);
    assert_eq!(names(dir), ["broken.toml", "other.toml"]);
}

#[cfg(unix)]
#[test]
fn a_cell_is_served_saved_and_ended_by_ctrl_c() {
    if platewash::viewer::bundle::Bundle::embedded().is_none() {
        return;
    }
    let folder = folder();
    let dir = folder.path();
    let mut edit = start(&mut command(dir, &["edit", "--no-open", "--json", "--seed", "3"]));
    let url = line_after(&mut edit.stdout, "  \"url\": ");
    let url = url.trim_end_matches(',').trim_matches('"').to_owned();
    let (url, token) = url.split_once("#token=").unwrap();
    let page = all(ask(url, "/", ""));
    assert!(page.starts_with("HTTP/1.1 200 OK\r\n") && !page.contains(token));
    // Whoever has the page alone asks in vain.
    for path in ["/hello", "/cell", "/save"] {
        assert!(post(url, path, "", &serde_json::json!({})).starts_with("HTTP/1.1 403"));
    }
    let block = page.split_once("id=\"platewash-edit\">").unwrap().1;
    let block: Value = serde_json::from_str(block.split_once("</script>").unwrap().0).unwrap();
    let text = block["text"].as_str().unwrap();
    assert!(text.contains("seed = 3"), "{text}");
    assert_eq!(
        (&block["file"], &block["saved"]),
        (&Value::from("kitchen.toml"), &Value::Null)
    );
    let save = serde_json::json!({"session": "sessionofthistest", "text": text, "disk": null, "force": false});
    assert!(post(url, "/save", "wrong", &save).starts_with("HTTP/1.1 403"));
    assert!(names(dir).is_empty());
    let saved = post(url, "/save", token, &save);
    assert!(
        saved.contains("\"kind\":\"saved\"") && saved.contains("PROVED"),
        "{saved}"
    );
    let beside = [
        "certificate.json",
        "page.html",
        "plan.json",
        "report.json",
        "report.txt",
    ]
    .map(|name| format!("kitchen.{name}"));
    assert_eq!(names(dir), [&beside[..], &["kitchen.toml".to_owned()]].concat());
    assert_eq!(std::fs::read_to_string(dir.join("kitchen.toml")).unwrap(), text);
    platewash(dir, &["verify", "kitchen.plan.json", "--against", "kitchen.toml"]).done();
    // The file is there now, and the scenario that is edited.
    let again = all(ask(url, "/", ""));
    assert!(again.contains("\"saved\":\"#"), "the page has what stands on disk");
    // A file keeps its mode, a read-only one is let be, and what is no file is not read.
    let file = dir.join("kitchen.toml");
    let mode = |bits| std::fs::set_permissions(&file, Permissions::from_mode(bits)).unwrap();
    let mut again = save.clone();
    (again["text"], again["force"]) = (text.replace("seed = 3", "seed = 4").into(), true.into());
    mode(0o444);
    assert!(post(url, "/save", token, &again).contains("read-only"));
    assert_eq!(std::fs::read_to_string(&file).unwrap(), text);
    mode(0o600);
    assert!(post(url, "/save", token, &again).contains("\"kind\":\"saved\""));
    assert_eq!(std::fs::metadata(&file).unwrap().permissions().mode() & 0o777, 0o600);
    // Without a plan nothing of the one before stays.
    again["text"] = text
        .replace("region = \"appendix\"", "positions_m = [[0.9, 0.0]]")
        .into();
    let saved = post(url, "/save", token, &again);
    assert!(
        saved.contains("INFEASIBLE") && saved.contains("3 files of an earlier save removed"),
        "{saved}"
    );
    assert_eq!(
        names(dir),
        ["kitchen.report.json", "kitchen.report.txt", "kitchen.toml"]
    );
    std::fs::remove_file(&file).unwrap();
    assert!(Command::new("mkfifo").arg(&file).status().unwrap().success());
    let look = serde_json::json!({"session": "sessionofthistest", "disk": null});
    assert!(post(url, "/disk", token, &look).contains("not a regular file"));
    std::fs::remove_file(&file).unwrap();
    edit.interrupt();
    assert_eq!(edit.end().0, Some(0));
}

/// Another user of the machine sees what programs are called with, and the files that all may read.
#[cfg(target_os = "linux")]
#[test]
fn other_users_of_the_machine_cannot_read_the_token() {
    use std::os::unix::fs::MetadataExt;
    use std::os::unix::process::CommandExt;
    const OTHER_USER: u32 = 65534;
    if platewash::viewer::bundle::Bundle::embedded().is_none() {
        return;
    }
    if std::fs::metadata("/proc/self").unwrap().uid() != 0 {
        eprintln!("skipped: only root can act as another user");
        return;
    }
    let folder = folder();
    let dir = folder.path();
    std::fs::set_permissions(dir, Permissions::from_mode(0o777)).unwrap();
    // The browser goes on, so that its command line can be looked at.
    let browser = "#!/bin/sh\necho \"$1\" > opened.part\nmv opened.part opened\nsleep 5\n";
    let opener = dir.join("xdg-open");
    std::fs::write(&opener, browser).unwrap();
    std::fs::set_permissions(&opener, Permissions::from_mode(0o755)).unwrap();
    let path = format!("{}:{}", dir.display(), std::env::var("PATH").unwrap());
    let mut edit = command(dir, &["edit", "--json"]);
    let mut edit = start(edit.env("PATH", path).env("TMPDIR", dir));
    let url = line_after(&mut edit.stdout, "  \"url\": ");
    let (url, token) = url
        .trim_end_matches(',')
        .trim_matches('"')
        .split_once("#token=")
        .unwrap();
    let opened = dir.join("opened");
    while !opened.exists() {
        std::thread::sleep(std::time::Duration::from_millis(20));
    }
    let page = std::fs::read_to_string(&opened).unwrap();
    assert!(
        std::fs::read_to_string(page.trim()).unwrap().contains(token),
        "the owner reads it"
    );
    let by_other = |file: &str| {
        let read = Command::new("cat").arg(file).uid(OTHER_USER).gid(OTHER_USER).output();
        read.unwrap().stdout
    };
    let processes = std::fs::read_dir("/proc").unwrap().flatten();
    let called: Vec<_> = processes
        .flat_map(|process| by_other(&process.path().join("cmdline").display().to_string()))
        .collect();
    let called = String::from_utf8_lossy(&called);
    assert!(called.contains(page.trim()) && !called.contains(token), "{called}");
    assert_eq!(by_other(opened.to_str().unwrap()), (page.clone()).into_bytes());
    assert!(by_other(page.trim()).is_empty());
    assert!(by_other(&format!("/proc/{}/environ", edit.child.id())).is_empty());
    // Sends what the page would send, but for the token.
    let request = format!(
        "exec 3<>/dev/tcp/{0}; printf 'POST /hello HTTP/1.1\\r\\nHost: {1}\\r\\nOrigin: http://{1}\\r\\nContent-Type: application/json\\r\\nContent-Length: 2\\r\\nConnection: close\\r\\n\\r\\n{{}}' >&3; cat <&3",
        url.trim_start_matches("http://")
            .trim_end_matches('/')
            .replace(':', "/"),
        url.trim_start_matches("http://").trim_end_matches('/'),
    );
    let asked = Command::new("bash")
        .args(["-c", &request])
        .uid(OTHER_USER)
        .gid(OTHER_USER)
        .output();
    let answer = String::from_utf8_lossy(&asked.unwrap().stdout).into_owned();
    assert!(
        answer.starts_with("HTTP/1.1 403") && !answer.contains(token),
        "{answer}"
    );
    edit.interrupt();
    assert_eq!(edit.end().0, Some(0));
}
